"""One run of a task in one reality, from its seed to what is kept of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from math import inf
from pathlib import Path

from skillc_compiler.library import codec
from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.assignment import Assignment, Perform, Prepared, Reach, Refused, prepare
from skillc_runtime.report.summary import Choices, summarise
from skillc_runtime.report.wiping import find_wipings
from skillc_runtime.scene.load import load_scene
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.task import execute
from skillc_runtime.trace.events import Listener
from skillc_runtime.trace.known import assumed
from skillc_runtime.trials.disturbance import Person, reality
from skillc_runtime.trials.measures.evidence import Evidence
from skillc_runtime.trials.measuring import works
from skillc_runtime.trials.trial import Disturbance, Trial
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError, number
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTACT_FORCE_LIMIT
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class Experiment:
    """What is tried, as it goes from one process to another: a compiled library as JSON, its task, a scene's file."""

    library: bytes
    task: str
    scene: Path
    disturbance: Disturbance


class Laboratory:
    """Runs trials of one experiment; everything that is the same in all of them is done once."""

    def __init__(self, experiment: Experiment) -> None:
        """Load and plan; LibraryError, SceneError or OSError where what is tried cannot be loaded."""
        self._library = codec.loads(experiment.library, "the library")
        self._state = load_scene(experiment.scene, self._library.vocabulary)
        self._disturbance = experiment.disturbance
        self._prepared = prepare(_assignment(experiment.task, self._library, self._state), self._library)

    def run(self, seed: int) -> Trial:
        """Run the task once."""
        if isinstance(self._prepared, Refused):
            return Trial(seed=seed, status="refused", reason=self._prepared.why)
        try:
            cell = SimulatedCell(WorldModel(self._state), seed, reality=partial(reality, self._disturbance))
        except (SheetError, FrameError) as error:
            return Trial(seed=seed, status="refused", reason=f"the scene cannot be simulated: {error}")
        return self._run(self._prepared, cell)

    def _run(self, prepared: Prepared, cell: SimulatedCell) -> Trial:
        choices, person = Choices(), Person(cell)
        pushed: Sequence[Listener] = (person,) if self._disturbance == "push" else ()
        execution = execute(prepared, self._library, cell, (choices, *pushed), person.watch)
        trees = tuple(attempt.tree for attempt in execution.attempts)
        wipings = find_wipings(trees, choices, cell)
        result = summarise(execution, choices, self._library, wipings)
        judged = tuple(zip(wipings, result.wipings, strict=True))
        return Trial(
            seed=cell.variation.seed,
            status=result.status,
            reason=result.failure,
            verified=result.verified,
            assumed=tuple(fact.fact for fact in assumed(result.facts)),
            variation=result.variation,
            works=works(Evidence(self._library, cell, trees, choices, judged)),
            coverage=min((surface.fraction for surface in cell.coverage.values()), default=1.0),
            greatest_force_n=_greatest_force(cell),
            force_limit_n=_force_limit(cell),
            pushed=person.pushed,
            at_rest=cell.at_rest,
            sim_time_s=result.sim_time_s,
            wall_time_s=result.wall_time_s,
        )


def _assignment(task: str, library: SkillLibrary, state: WorldState) -> Assignment:
    goal, body = library.tasks[task].goal, library.tasks[task].body
    if goal is not None:
        return Assignment(task, state, Reach(goal))
    assert body is not None, "a task has a goal or a body"
    return Assignment(task, state, Perform(body))


def _greatest_force(cell: SimulatedCell) -> float:
    return max((cell.strongest_force(tool.individual) for tool in cell.facts.tools), default=0.0)


def _force_limit(cell: SimulatedCell) -> float | None:
    sheets = [arm.sheet for arm in cell.facts.arms]
    limits = [number(sheet.state, sheet.individual, CONTACT_FORCE_LIMIT, default=inf) for sheet in sheets]
    least = min(limits, default=inf)
    return None if least == inf else least
