"""Runs one test in a cell without bodies."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from time import perf_counter

import msgspec

from skillc.services.testing.coverage import Coverage
from skillc.services.testing.path import CallPath
from skillc_model.declared import settle_outcomes
from skillc_model.skills import SkillLibrary, Test
from skillc_runtime.backends.symbolic.cell import SymbolicCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, NotStarted
from skillc_runtime.execution.attempt import CellOrigin
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.execute import drive, prepare_after
from skillc_runtime.execution.preparation import Ready, prepare_here
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.planning.schedule import Planners
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.recording.states import EndState
from skillc_runtime.world.eval.effects import changes_of
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState

LIMIT_S = 24 * 3600.0
"""How long a test may take, in s of its cell: one that waits for what never happens ends then, which costs no time."""


class TestRun(msgspec.Struct, frozen=True):
    """How the task of a test has ended, in which world, and what has led there.

    `refused` is why it did not start, empty if it did; `proved`, with a goal, if there is no plan. `cell_s` is how long
    it took in s of the cell, `wall_s` in s of wall time.
    """

    state: WorldState
    status: EndState | None = None
    failure: Failure | None = None
    refused: str = ""
    proved: bool = False
    path: CallPath = msgspec.field(default_factory=CallPath)
    cell_s: float = 0.0
    wall_s: float = 0.0


def run_test(
    test: Test, library: SkillLibrary, scene: WorldState, file: Path, planners: Planners, coverage: Coverage
) -> TestRun:
    """Run a test of a library that acts as declared, in a scene without bodies; what it covers is added.

    WorldError if what it starts with contradicts the scene.
    """
    began, library = perf_counter(), settle_outcomes(library, test.outcomes)
    world = _make_world(test, scene)
    if test.goal is not None:
        objective: AchieveGoal | ExecuteBody = AchieveGoal(test.goal)
    else:
        assert test.body is not None, "a test has a goal or a body"
        objective = ExecuteBody(test.body)
    assignment = Assignment(test.name, world.snapshot(), objective, always=test.always)
    prepared = prepare_task(assignment, library, planners=planners)
    if isinstance(prepared, NotStarted):
        proved = prepared.proved and test.goal is not None
        return TestRun(world.snapshot(), refused=prepared.reason, proved=proved, wall_s=perf_counter() - began)
    cell, path = SymbolicCell(world), CallPath()
    start = prepare_after(Ready(prepared), prepare_here(library))
    loop = CellLoop(cell, library, start, CellOrigin(str(file), backend="symbolic"))
    run = loop.submit(assignment, (path, coverage), RunSpec(deadline_s=LIMIT_S, geometry=False))
    drive(loop, run)
    return TestRun(world.snapshot(), run.end, run.failure, path=path, cell_s=cell.now, wall_s=perf_counter() - began)


def _make_world(test: Test, scene: WorldState) -> WorldModel:
    """Return the world of a scene in which what a test starts with is so."""
    world = WorldModel(scene)
    if changes := changes_of(test.starts, scene, _NO_NAMES):
        world.commit(changes, test.name, "assumed")
    return WorldModel(world.snapshot())


_NO_NAMES: Mapping[str, str] = {}


def describe_end(run: TestRun) -> str:
    """Return why a run did not succeed, as a sentence; empty if it did."""
    if run.refused:
        return run.refused
    if run.status == "succeeded":
        return ""
    return run.failure.message if run.failure is not None else f"it ended as {run.status}"
