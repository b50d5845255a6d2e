"""Runs the case of a seed: its world model says what is believed, its simulation is what is real."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

import mujoco

from random_cells.drawing import TABLE_M
from random_cells.happening import Hand
from random_cells.spoiling import AWAY_M, SERIES, Case
from random_cells.writing import TASK, format_scene, write_cell
from skillc.errors import DiagnosticsError
from skillc.services.cell_checks.starting import find_start_problem
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.tasks.loading import LoadedTask, load_task
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.evaluation.trials.trial import Trial
from skillc_runtime.execution.assignment import NotStarted
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.failure_text import describe_failure
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.difference import changes_between
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAIN
from skillc_runtime.world.state.world_state import WorldState

LAB = "http://example.org/lab#"
Backend: TypeAlias = Literal["mujoco", "kinematic"]


@dataclass(frozen=True, slots=True)
class CaseRunner:
    """Runs cases of a series; what they consist of is written into a folder for each seed."""

    out: Path
    backend: Backend = "mujoco"
    most_parts: int = 12
    series: str = "spoilt"

    def run(self, seed: int) -> Trial:
        """Run the case of a seed."""
        case = SERIES[self.series](seed, self.most_parts)
        folder = self.out / f"cell_{seed}"
        write_cell(case.believed, folder)
        try:
            with load_task(RunSpec(task=f"{folder}:{TASK}"), SilentReporter()) as task:
                return self._run(case, folder, task)
        except DiagnosticsError as error:
            return Trial(seed=seed, status="refused", reason="\n".join(each.message for each in error.diagnostics))
        except (SheetError, FrameError) as error:
            return Trial(seed=seed, status="refused", reason=str(error))

    def _run(self, case: Case, folder: Path, task: LoadedTask) -> Trial:
        problem = find_start_problem(task, SilentReporter())
        if problem is not None:
            return Trial(seed=case.seed, status="refused", reason=problem)
        prepared = prepare_task(task.assignment, task.library)
        if isinstance(prepared, NotStarted):
            return Trial(seed=case.seed, status="refused", reason=prepared.reason)
        real, believed = _load_reality(case, folder, task), task.assignment.state
        cell = self._make_cell(real, believed, case.seed)
        somebody = _make_somebody(case, cell)
        listeners = (somebody,) if isinstance(somebody, Hand) else ()
        execution = execute_task(prepared, task.library, cell, listeners, somebody.update)
        return Trial(
            seed=case.seed,
            status=execution.status,
            reason=describe_failure(execution.failure) if execution.failure else None,
            verified=execution.verified,
            at_rest=cell.is_at_rest(),
            pushed=isinstance(somebody, Hand) and somebody.acted,
            sim_time_s=cell.now,
            false_claims=execution.false_claims,
        )

    def _make_cell(self, real: WorldState, believed: WorldState, seed: int) -> SimulatedCell | KinematicCell:
        """Build what is real; then let the world model say what is believed, as if a person had stated it."""
        world = WorldModel(real)
        cell = SimulatedCell(world, seed) if self.backend == "mujoco" else KinematicCell(world)
        changes = changes_between(world.snapshot(), believed)
        if changes:
            world.commit(changes, "what is believed", None)
        return cell


def _load_reality(case: Case, folder: Path, task: LoadedTask) -> WorldState:
    """Return the world as it is: the believed one, or that of a scene of its own, which is written beside it."""
    if case.real == case.believed:
        return task.assignment.state
    scene = folder / "reality.ttl"
    scene.write_text(format_scene(case.real, folder.name), "utf-8")
    return load_scene(scene, task.library.vocabulary)


def _make_somebody(case: Case, cell: SimulatedCell | KinematicCell) -> Hand | Thief:
    part, bin_ = case.believed.goal[-1]
    return Thief(case, cell) if case.happening is None else Hand(case.happening, LAB + part, LAB + bin_, cell)


class Thief:
    """Takes a part away at a time of a run, unless it is held or has been put where it belongs."""

    def __init__(self, case: Case, cell: SimulatedCell | KinematicCell) -> None:
        self._case, self._cell = case, cell
        self._done = case.taken_at_s is None

    def update(self) -> None:
        """Take the part away once its time has come."""
        if self._done or self._cell.now < (self._case.taken_at_s or 0.0):
            return
        self._done = True
        cell, part, bin_ = self._cell, LAB + self._case.victim, LAB + self._case.believed.goal[-1][1]
        if cell.ground_truth.carried_by(LAB + "Hand-1") == part or part in cell.world.snapshot().objects(bin_, CONTAIN):
            return
        joint = cell.model.joint(part_name(cell.scene.names[part], "free"))
        position, speed = int(joint.qposadr[0]), int(joint.dofadr[0])
        cell.data.qpos[position : position + 3] = [*AWAY_M, TABLE_M / 4]
        cell.data.qvel[speed : speed + 6] = 0.0
        mujoco.mj_kinematics(cell.model, cell.data)
