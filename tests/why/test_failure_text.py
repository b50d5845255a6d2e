"""A failure is one sentence that leads with its cause, and a tree of details."""

from __future__ import annotations

import pytest

from skillc_dsl.position import Position
from skillc_runtime.execution.selection.select import combine_rejections
from skillc_runtime.recording.failure import Failure, Rejection, Stage
from skillc_runtime.recording.failure_text import describe_failure, list_details

HERE = Position("work.skill", 3, 1)
NO_CAMERA = "pre `exists camera: Camera` does not hold: there is no Camera"
FULL = "the bin is full: no place of 33 x 33 mm is free"


def rejected(implementation: str, stage: Stage, reason: str) -> Rejection:
    return Rejection(implementation=implementation, stage=stage, reason=reason, source=HERE)


@pytest.mark.parametrize(
    ("rejections", "sentence"),
    [
        ([rejected("confirmed", "pre", NO_CAMERA), rejected("felt", "start", FULL)], FULL),
        ([rejected("confirmed", "pre", NO_CAMERA)], NO_CAMERA),
        (
            [rejected("one", "pre", NO_CAMERA), rejected("other", "argument", "`arm` needs CompliantArm")],
            f"no implementation of Place fits: one: {NO_CAMERA}; other: `arm` needs CompliantArm",
        ),
        (
            [rejected("across", "start", "it is too wide"), rejected("above", "run", "it has slipped")],
            "it has slipped; other ways were tried: Place[across]: it is too wide",
        ),
        ([rejected("across", "run", "it has slipped"), rejected("above", "run", "it has slipped")], "it has slipped"),
        (
            [rejected(name, "run", f"{name} failed") for name in ("a", "b", "c", "d", "e")],
            "a failed; other ways were tried: Place[b]: b failed; Place[c]: c failed; Place[d]: d failed; and 1 more",
        ),
        ([], "Place has no implementation"),
    ],
)
def test_what_got_furthest_leads_and_what_was_never_tried_is_not_in_the_sentence(
    rejections: list[Rejection], sentence: str
) -> None:
    assert describe_failure(combine_rejections("Place", rejections, HERE)) == sentence


def test_the_details_have_everything_below_what_it_explains() -> None:
    failure = combine_rejections(
        "Place", [rejected("confirmed", "pre", NO_CAMERA), rejected("felt", "start", FULL)], HERE
    )
    plan = Failure(kind="plan", message="no other plan was found", detail="the goal cannot be reached")
    whole = Failure(kind="plan", message=failure.message, causes=(failure, plan))
    assert describe_failure(whole) == f"{FULL}; no other plan was found"
    assert list(list_details(whole)) == [
        f"{FULL} (work.skill:3)",
        f"  Place[felt]: {FULL} (work.skill:3)",
        f"  Place[confirmed]: {NO_CAMERA} (work.skill:3)",
        "no other plan was found",
        "  the goal cannot be reached",
    ]
