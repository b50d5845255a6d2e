"""The report says why an implementation was taken."""

from __future__ import annotations

import pytest

from skillc_dsl.position import Position
from skillc_runtime.evaluation.report.result import ChoiceResult, StepResult, TaskResult
from skillc_runtime.evaluation.report.summary import summarise_recording
from skillc_runtime.evaluation.report.table import format_choice_reason
from skillc_runtime.recording.failure import Rejection
from skillc_runtime.recording.history.history_builder import read_history
from tree.library import Library, act, world
from tree.stage import Script, Stage
from why.stories import events_of, known

TOO_WIDE = Rejection(implementation="wsg", stage="type", reason="too wide", source=Position("grip.skill", 1, 1))


def step(alternatives: int, *rejected: Rejection, fixed: bool = False) -> StepResult:
    return StepResult(
        skill="Grip",
        implementation="robotiq",
        arguments={},
        source="grip.skill:1",
        status="success",
        fixed=fixed,
        alternatives=alternatives,
        rejected=rejected,
    )


@pytest.mark.parametrize(
    ("taken", "reason"),
    [
        (step(0), "the only one"),
        (step(0, fixed=True), "named by the call"),
        (step(1), "the first that fits"),
        (step(1, TOO_WIDE), "not wsg: too wide"),
        (ChoiceResult(skill="Grip", implementation="robotiq"), "the first that fits"),
    ],
)
def test_a_sole_implementation_was_not_chosen(taken: StepResult | ChoiceResult, reason: str) -> None:
    assert format_choice_reason(taken) == reason


def test_an_implementation_that_refuses_to_start_is_no_other_one() -> None:
    story = known(read_history(events_of(act("a"), Library().build(), Stage(world(), {"a": [Script("refuse")]}))))
    (taken,) = summarise_recording(TaskResult(task="play", status="failed"), story, 1.0).plan
    assert (taken.status, taken.failure) == ("failure", "a refuses")
    assert (taken.alternatives, taken.rejected, format_choice_reason(taken)) == (0, (), "the only one")
