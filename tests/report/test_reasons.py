"""The report says why an implementation was taken."""

from __future__ import annotations

import pytest

from skillc_rdf.vocabulary.types import Position
from skillc_runtime.evaluation.report.result import ChoiceResult, StepResult
from skillc_runtime.evaluation.report.table import format_choice_reason
from skillc_runtime.recording.failure import Rejection

TOO_WIDE = Rejection(implementation="wsg", stage="type", reason="too wide", source=Position("grip.skill", 1, 1))


def step(alternatives: int, *rejected: Rejection) -> StepResult:
    return StepResult(
        skill="Grip",
        implementation="robotiq",
        arguments={},
        source="grip.skill:1",
        status="success",
        alternatives=alternatives,
        rejected=rejected,
    )


@pytest.mark.parametrize(
    ("taken", "reason"),
    [
        (step(0), "the only one"),
        (step(1), "the first that fits"),
        (step(1, TOO_WIDE), "not wsg: too wide"),
        (ChoiceResult(skill="Grip", implementation="robotiq"), "the first that fits"),
    ],
)
def test_a_sole_implementation_was_not_chosen(taken: StepResult | ChoiceResult, reason: str) -> None:
    assert format_choice_reason(taken) == reason
