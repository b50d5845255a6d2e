"""Runs one trial of a task: a simulation with the variation of a seed, and its measurements."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import partial
from math import inf
from typing import TypeAlias

from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.evaluation.measures import buttons, placements, poses, sockets, surfaces
from skillc_runtime.evaluation.measures.evidence import RunEvidence
from skillc_runtime.evaluation.measures.work import Work
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.summary import summarise_run
from skillc_runtime.evaluation.report.wiping import find_recorded_wipings
from skillc_runtime.evaluation.trials.disturbance import PushDisturbance, TakeDisturbance, TrialCell
from skillc_runtime.evaluation.trials.settings import Setting, apply_settings
from skillc_runtime.evaluation.trials.trial import Trial, TrialDisturbance
from skillc_runtime.evaluation.trials.trial_cell import make_trial_cell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, NotStarted, PreparedTask
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.execute import execute_task, make_loop
from skillc_runtime.execution.refinement.run_planning import SpaceLook, measure_postures
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.recording.events import Listener
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.recording.known_facts import unverified_facts
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError, number_of, sheet_of
from skillc_runtime.world.state.labels.labelled_text import format_fact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import ARM_DEVICE, CONTACT_FORCE_LIMIT, SURFACE, TOOL
from skillc_runtime.world.state.world_state import WorldState

MEASURES = (surfaces.measure, buttons.measure, sockets.measure, poses.measure)
"""The measures of the kinds of work that need evidence, in the order in which trials list them."""
MOST_VARIANTS = 16
"""How many libraries with settings are kept with their plans."""


RecordTrial: TypeAlias = Callable[[TrialCell], AbstractContextManager[Sequence[Listener]]]
"""Records what happens in the cell of a trial in a `with` statement, which yields who gets the events."""


class NotRecorded(Exception):
    """A trial cannot be recorded, because its task does not start; the message says why."""


@dataclass(frozen=True, slots=True)
class _Variant:
    """A library with settings, and the task as it is planned with it."""

    library: SkillLibrary
    prepared: PreparedTask | NotStarted


class TrialRunner:
    """Runs trials of a task of a library in the world of a scene; planning is done once for trials of equal settings.

    Durations and conditions may depend on what is set, so that other settings have a plan of their own. Plans are
    looked at in space as those of runs are: first from home, in a trial from where its arms are.
    """

    def __init__(self, library: SkillLibrary, state: WorldState, task: str, disturbance: TrialDisturbance) -> None:
        """Plan."""
        self._library, self._state, self._task, self._disturbance = library, state, task, disturbance
        self._variants: dict[tuple[Setting, ...], _Variant] = {}
        self._prepare(())

    def run(self, seed: int, *settings: Setting) -> Trial:
        """Run the trial of a seed."""
        variant = self._prepare(settings)
        if isinstance(variant.prepared, NotStarted):
            return Trial(seed=seed, status="refused", reason=variant.prepared.reason)
        try:
            cell = make_trial_cell(WorldModel(self._state), seed, self._disturbance)
        except (SheetError, FrameError) as error:
            return Trial(seed=seed, status="refused", reason=f"the scene cannot be simulated: {error}")
        return self._run(variant.library, variant.prepared, cell).measure(cell)

    def begin(self, seed: int, listener: Listener) -> tuple[CellLoop, TaskRun]:
        """Submit the run of the trial of a seed to a loop of its own, which the caller ticks and closes.

        NotRecorded, SheetError or FrameError if it cannot start.
        """
        variant = self._prepare(())
        if isinstance(variant.prepared, NotStarted):
            raise NotRecorded(variant.prepared.reason)
        cell = make_trial_cell(WorldModel(self._state), seed, self._disturbance)
        loop = make_loop(variant.prepared, variant.library, cell, find_look=partial(_look_from, cell))
        return loop, loop.submit(variant.prepared.assignment, (listener,))

    def record(self, seed: int, recording: RecordTrial, *settings: Setting) -> tuple[TaskResult, Trial]:
        """Run the trial of a seed and record it; NotRecorded, SheetError or FrameError if it cannot start."""
        variant = self._prepare(settings)
        if isinstance(variant.prepared, NotStarted):
            raise NotRecorded(variant.prepared.reason)
        cell = make_trial_cell(WorldModel(self._state), seed, self._disturbance)
        with recording(cell) as listeners:
            executed = self._run(variant.library, variant.prepared, cell, listeners)
            return executed.result, executed.measure(cell)

    def _prepare(self, settings: tuple[Setting, ...]) -> _Variant:
        """Return the library with settings, and its plan, which is kept while others of the latest are asked for."""
        if settings not in self._variants:
            library = apply_settings(self._library, settings)
            prepared = prepare_task(_make_assignment(self._task, library, self._state), library, look=SpaceLook())
            while len(self._variants) >= MOST_VARIANTS:
                del self._variants[next(iter(self._variants))]
            self._variants[settings] = _Variant(library, prepared)
        return self._variants[settings]

    def _run(
        self, library: SkillLibrary, prepared: PreparedTask, cell: TrialCell, listeners: Sequence[Listener] = ()
    ) -> _Executed:
        told, push, take = HistoryBuilder(), PushDisturbance(cell), TakeDisturbance(cell)
        disturbances: Sequence[Listener] = (push,) if self._disturbance == "push" else ()
        update = take.update if self._disturbance == "take" else push.update
        listeners = (told, *disturbances, *listeners)
        execution = execute_task(prepared, library, cell, listeners, update, find_look=partial(_look_from, cell))
        history, state, truth = told.history, cell.world.snapshot(), cell.ground_truth
        wipings = find_recorded_wipings(history, state, truth)
        result = summarise_run(execution, history, wipings, cell)
        rated = {each.surface: (each, how) for each, how in zip(wipings, result.wipings, strict=True)}
        evidence = RunEvidence(library, state, truth, history, tuple(rated.values()))
        return _Executed(result, evidence, push.pushed, take.taken)


@dataclass(frozen=True, slots=True)
class _Executed:
    """A trial that has ended, before it is measured."""

    result: TaskResult
    evidence: RunEvidence
    pushed: bool
    taken: bool

    def measure(self, cell: TrialCell) -> Trial:
        """Return the trial with what was measured, while the cell is as it was at its end."""
        result, state, truth = self.result, self.evidence.state, self.evidence.truth
        return Trial(
            seed=result.seed,
            status=result.status,
            reason=result.failure,
            verified=result.verified,
            false_claims=result.false_claims,
            assumed=tuple(format_fact(fact.fact) for fact in unverified_facts(result.facts)),
            variation=result.variation,
            works=(*_measure_work(self.evidence), *placements.measure(result.placements)),
            coverage=_least_coverage(state, truth),
            greatest_force_n=_greatest_force_n(state, truth),
            force_limit_n=_force_limit_n(state),
            pushed=self.pushed,
            taken=self.taken,
            at_rest=cell.is_at_rest(),
            sim_time_s=result.sim_time_s,
        )


def _look_from(cell: TrialCell) -> SpaceLook:
    return SpaceLook(measure_postures(cell))


def _make_assignment(task: str, library: SkillLibrary, state: WorldState) -> Assignment:
    found = library.tasks[task]
    if found.goal is not None:
        return Assignment(
            task, state, AchieveGoal(found.goal, found.minimise), within_s=found.within_s, always=found.always
        )
    assert found.body is not None, "a task has a goal or a body"
    return Assignment(task, state, ExecuteBody(found.body), within_s=found.within_s, always=found.always)


def _measure_work(evidence: RunEvidence) -> tuple[Work, ...]:
    return tuple(work for measure in MEASURES for work in measure(evidence))


def _least_coverage(state: WorldState, truth: GroundTruth) -> float | None:
    return min((truth.coverage(each).wiped_share for each in state.instances(SURFACE)), default=None)


def _greatest_force_n(state: WorldState, truth: GroundTruth) -> float | None:
    return max((truth.peak_force_n(tool) for tool in state.instances(TOOL)), default=None)


def _force_limit_n(state: WorldState) -> float | None:
    sheets = [sheet_of(state, arm).individual for arm in state.instances(ARM_DEVICE)]
    limits = [number_of(state, sheet, CONTACT_FORCE_LIMIT, default=inf) for sheet in sheets]
    least = min(limits, default=inf)
    return None if least == inf else least
