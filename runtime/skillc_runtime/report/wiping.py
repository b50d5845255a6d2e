"""Finds the wiping in a task and judges it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import inf

from skillc_runtime.report.choices import Choices
from skillc_runtime.report.result import WipingResult
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.simulation.metrics import Stroke, Wiped, wiping_metrics
from skillc_runtime.trace.events import ImplementationChosen
from skillc_runtime.trace.outcome import Outcome
from skillc_runtime.world.space.frames import size
from skillc_runtime.world.state.terms import SURFACE, TOOL
from skillc_runtime.world.state.world_state import WorldState

PATH_SKILL, PUSH_SKILL = "FollowPath", "Push"
"""The standard skills between which a surface is wiped: a path is followed while the tool is pushed."""


@dataclass(frozen=True, slots=True)
class Wiping:
    """A tool, pushed with `force_n`, followed paths on a surface; the skill `began` before.

    Between two strokes, each from one time to another, it was lifted. `arm` is empty where the skill names none.
    """

    surface: str
    arm: str
    tool: str
    force_n: float
    began: float
    strokes: tuple[Stroke, ...]

    @property
    def start(self) -> float:
        """When the first path was begun."""
        return self.strokes[0][0]

    @property
    def end(self) -> float:
        """When the last path was done."""
        return self.strokes[-1][1]


def find_wipings(trees: Iterable[Outcome], choices: Choices, cell: SimulatedCell) -> tuple[Wiping, ...]:
    """Return for each surface the last call about it and a tool in which, pushing, paths were followed to the end."""
    state, found = cell.world.snapshot(), dict[str, Wiping]()
    for node in (node for tree in trees for node in tree.nodes()):
        individuals = _individuals(choices.get(node.id), state)
        surfaces = [each for each in individuals if state.is_a(each, SURFACE)]
        tools = [each for each in individuals if state.is_a(each, TOOL)]
        arm = next((each for each in individuals if each in cell.arms), "")
        pushes = [choice.bindings["force"] for choice, _ in _done(node, choices, PUSH_SKILL)]
        strokes = tuple(sorted(_strokes(node, choices)))
        if surfaces and tools and pushes and strokes:
            force, began = float(pushes[-1].split()[0]), node.started or 0.0
            found[surfaces[0]] = Wiping(surfaces[0], arm, tools[0], force, began, strokes)
    return tuple(found.values())


def described(wiping: Wiping, cell: SimulatedCell) -> Wiped:
    """Return what was wiped with what, as it really was."""
    surface = next(each for each in cell.facts.surfaces if each.individual == wiping.surface)
    tool = size(cell.world.snapshot(), wiping.tool)[:2]
    return Wiped(cell.true_pose(surface), surface.layout, tool, wiping.force_n, surface.least_n)


def judge(wiping: Wiping, cell: SimulatedCell) -> WipingResult:
    """Measure how good the wiping was."""
    recording = cell.recording(wiping.tool).between(wiping.began, wiping.end)
    metrics = wiping_metrics(recording, wiping.strokes, described(wiping, cell))
    dwell = metrics.lane_dwell
    return WipingResult(
        surface=cell.world.snapshot().vocabulary.short(wiping.surface),
        coverage=metrics.coverage,
        force_command_n=metrics.force_command_n,
        force_mean_n=metrics.force_mean_n,
        force_rmse_n=metrics.force_rmse_n,
        contact_lost=metrics.contact_lost,
        vibration_mm_s=metrics.vibration_mm_s,
        tilt_rms_deg=metrics.tilt_rms_deg,
        first_impact_n=metrics.first_impact_n,
        tracking_rms_mm=metrics.tracking_mm,
        lane_dwell_s=dwell.seconds if dwell else None,
        lane_dwell_of=dwell.of if dwell else "tool",
    )


def _individuals(choice: ImplementationChosen | None, state: WorldState) -> list[str]:
    """Return the individuals that a call was bound to."""
    if choice is None:
        return []
    names = {state.vocabulary.short(iri): iri for iri in state.individuals}
    return [names[value] for value in choice.bindings.values() if value in names]


def _strokes(node: Outcome, choices: Choices) -> Iterator[Stroke]:
    """Yield from when to when each path below a node was followed, in its last run."""
    for _, path in _done(node, choices, PATH_SKILL):
        first, last = node.started or 0.0, inf if node.ended is None else node.ended
        yield from (run for run in choices.runs.get(path.id, []) if run[0] >= first and run[1] <= last)


def _done(
    node: Outcome, choices: Mapping[int, ImplementationChosen], skill: str
) -> Iterator[tuple[ImplementationChosen, Outcome]]:
    """Yield the calls of a skill below a node that succeeded."""
    for each in node.nodes():
        choice = choices.get(each.id)
        if choice is not None and choice.skill == skill and each.status == "success":
            yield choice, each
