"""How far a run is along its plan, from the events of the run."""

from __future__ import annotations

import pytest

from skillc.cli.progress.run_display import format_estimate
from skillc.cli.progress.run_estimate import PlanProgress
from skillc_dsl.position import Position
from skillc_runtime.recording.events import NodeEnded, NodeStarted, PlanMade, Replanned
from skillc_runtime.recording.recorded_plan import PlanStep

HERE = Position("a.skill", 1, 1)
PLAN = PlanMade(
    time=10.0, planner="p", optimal="", cost=40.0, steps=(PlanStep(skill="A", arguments={}),) * 2, quality=""
)


def start(progress: PlanProgress, node: int, parent: int, kind: str = "call") -> None:
    progress.observe(NodeStarted(time=10.0, node=node, parent=parent, kind=kind, name="A", source=HERE), 0.0)


def end(progress: PlanProgress, node: int, status: str, at_s: float) -> str | None:
    ended = progress.observe(NodeEnded(time=at_s, node=node, name="A", status=status, source=HERE), 0.0)
    return None if ended is None else f"{ended.skill} {ended.status} {ended.at_s}"


def follow() -> PlanProgress:
    """Return the progress of a plan of two steps, 40 s long, in a sequence that begins at 10 s of the cell."""
    progress = PlanProgress()
    progress.observe(PLAN, wall_s=100.0)
    start(progress, 1, 0, "seq")
    start(progress, 2, 1)
    start(progress, 3, 2, "seq")
    start(progress, 4, 3)
    return progress


@pytest.mark.parametrize(
    ("now_s", "wall_s", "said", "share"),
    [
        (10.0, 100.0, "step 1 of 2, about 40 s", 0.0),
        (20.0, 105.0, "step 1 of 2, about 40 s, 15 s left", 0.25),
        (60.0, 125.0, "step 1 of 2, about 100 s, 25 s left", 0.5),
        (20.0, 200.0, "step 1 of 2, about 40 s, 5 min 0 s left", 0.25),
    ],
)
def test_a_step_that_takes_longer_than_expected_prolongs_the_plan(
    now_s: float, wall_s: float, said: str, share: float
) -> None:
    estimate = follow().estimate(now_s, wall_s)
    assert estimate is not None and (format_estimate(estimate), estimate.share) == (said, share)


def test_only_outermost_calls_are_steps() -> None:
    progress = follow()
    assert end(progress, 4, "success", 15.0) is None
    assert end(progress, 2, "success", 20.0) == "A success 20.0"
    estimate = progress.estimate(20.0, 105.0)
    assert estimate is not None and (estimate.step, estimate.share) == (2, 0.5)
    start(progress, 5, 1)
    assert end(progress, 5, "success", 50.0) == "A success 50.0"
    assert progress.estimate(50.0, 120.0) is None


def test_without_a_plan_nothing_is_estimated() -> None:
    progress = follow()
    assert end(progress, 2, "failure", 20.0) == "A failure 20.0"
    progress.observe(Replanned(time=20.0, reason="lost"), 105.0)
    assert progress.estimate(20.0, 105.0) is None
    assert PlanProgress().estimate(1.0, 1.0) is None
