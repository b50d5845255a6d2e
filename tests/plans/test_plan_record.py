"""A plan survives its recording: what is restored runs and describes itself as before."""

from __future__ import annotations

import msgspec
import pytest
from msgspec.structs import replace

from plans.depot import goal, library, world
from skillc_model import tree
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.plans.plan_body import build_plan_body
from skillc_runtime.execution.plans.plan_record import (
    record_arrangement,
    record_plan,
    restore_arrangement,
    restore_plan,
)
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.planning.arrangement import Arrangement, InParallel, InSeries, arrange_plan
from skillc_runtime.planning.plan import LeftOut, Solved, describe_quality
from skillc_runtime.recording.recorded_plan import ArrivedPlan, StepGroup
from skillc_runtime.recording.space_claim import ChosenImplementation, SpaceClaim

STATE = world({"ann": "a", "bob": "b"}, {"crate": "a", "box": "b"})
TEXT = "lab:c contain lab:crate and lab:d contain lab:box"


def planned() -> tuple[PreparedTask, Solved]:
    prepared = prepare_task(Assignment("carry", STATE, AchieveGoal(goal(TEXT, STATE))), library())
    assert isinstance(prepared, PreparedTask) and prepared.planned is not None, prepared
    return prepared, prepared.planned.solved


def through_a_file(solved: Solved) -> Solved:
    content = msgspec.json.encode(record_plan(solved, arrange_plan(solved.plan, library(), STATE), library()))
    return restore_plan(msgspec.json.decode(content, type=ArrivedPlan))


def test_the_same_body_is_built_of_a_plan_that_was_recorded() -> None:
    prepared, solved = planned()
    restored = through_a_file(solved)
    assert restored.plan == solved.plan and len(solved.plan.steps) > 2
    arrangement = arrange_plan(restored.plan, library(), STATE)
    assert build_plan_body(restored.plan, arrangement, library()) == prepared.body


def test_a_step_is_tried_first_in_the_way_that_was_looked_at() -> None:
    _, solved = planned()
    number = next(number for number, each in enumerate(solved.plan.steps, 1) if each.skill == "Unload")
    way = ChosenImplementation(number, "Unload", "tilt")
    space = SpaceClaim(checked=len(solved.plan.steps), steps=len(solved.plan.steps), implementations=(way,))
    body = build_plan_body(solved.plan, InSeries(tuple(range(len(solved.plan.steps)))), library(), space)
    assert isinstance(body, tree.Sequence) and way.text in space.text
    tried = [each.then for each in body.children if isinstance(each, tree.If)]
    assert [isinstance(each, tree.Selector) for each in tried] == [each == number for each in range(1, len(tried) + 1)]
    first = tried[number - 1]
    assert isinstance(first, tree.Selector)
    assert [call.implementation for call in first.children if isinstance(call, tree.Call)] == ["tilt", None]


@pytest.mark.parametrize(
    "arrangement",
    [
        InSeries(()),
        0,
        InSeries((0, 1)),
        InParallel((0, InSeries((1, InParallel((2, 3)))))),
        InSeries((0, InParallel((1, 2)))),
        InParallel((0, 1, 2, 3), ((), (), (0,), (0, 1))),
    ],
)
def test_an_arrangement_survives_its_recording(arrangement: Arrangement) -> None:
    content = msgspec.json.encode(record_arrangement(arrangement))
    assert restore_arrangement(msgspec.json.decode(content, type=StepGroup)) == arrangement


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"optimal": "proven"}, "proved optimal"),
        (
            {
                "optimal": "optimal for the filtered problem",
                "left_out": (LeftOut({"a", "b"}, "far away", False), LeftOut(("c",), "not movable", True, "skills")),
                "at_least_s": 3.5,
            },
            "optimal for the part of the scene that was planned with, any plan takes at least 3.5 s",
        ),
    ],
)
def test_a_recorded_plan_describes_its_quality_as_before(changes: dict[str, object], words: str) -> None:
    solved = replace(planned()[1], assumptions=("Go takes 5 s",), **changes)  # type: ignore[arg-type]
    restored = through_a_file(solved)
    assert describe_quality(restored.optimal, restored.left_out, restored.at_least_s) == words
    assert (restored.planner, restored.assumptions) == (solved.planner, solved.assumptions)
