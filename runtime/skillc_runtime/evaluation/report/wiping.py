"""Finds the wiping in a task and judges it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import inf

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.evaluation.metrics.wiping import Stroke, WipingSetup, measure_wiping
from skillc_runtime.evaluation.report.choices import Choices
from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.primitives.primitive import Activity
from skillc_runtime.recording.events import ImplementationChosen
from skillc_runtime.recording.node_outcome import NodeOutcome
from skillc_runtime.world.space.frames import size
from skillc_runtime.world.state.labelled import Quantity
from skillc_runtime.world.state.terms import SURFACE, TOOL

FORCE = "force"
"""The parameter, in N, of what declares that it presses."""


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


def find_wipings(trees: Iterable[NodeOutcome], choices: Choices, cell: SimulatedCell) -> tuple[Wiping, ...]:
    """Return for each surface the last call about it and a tool in which paths were followed while it was pressed."""
    state, found = cell.world.snapshot(), dict[str, Wiping]()
    for node in (node for tree in trees for node in tree.nodes()):
        choice = choices.get(node.id)
        individuals = [each for each in choice.individuals if each in state.individuals] if choice else []
        surfaces = [each for each in individuals if state.is_a(each, SURFACE)]
        tools = [each for each in individuals if state.is_a(each, TOOL)]
        arm = next((each for each in individuals if each in cell.arms), "")
        forces = [choice.bindings.get(FORCE) for choice, _ in _done(node, choices, "press")]
        pressed = [force.value for force in forces if isinstance(force, Quantity)]
        strokes = tuple(sorted(_strokes(node, choices)))
        if surfaces and tools and pressed and strokes:
            found[surfaces[0]] = Wiping(surfaces[0], arm, tools[0], pressed[-1], node.started or 0.0, strokes)
    return tuple(found.values())


def describe_wiping(wiping: Wiping, cell: SimulatedCell) -> WipingSetup:
    """Return what was wiped with what, as it really was."""
    surface = next(each for each in cell.scene.surfaces if each.individual == wiping.surface)
    tool = size(cell.world.snapshot(), wiping.tool)[:2]
    return WipingSetup(
        cell.ground_truth.surface_pose(surface.individual), surface.layout, tool, wiping.force_n, surface.least_n
    )


def judge_wiping(wiping: Wiping, cell: SimulatedCell) -> WipingResult:
    """Measure how good the wiping was."""
    recording = cell.ground_truth.recording(wiping.tool).between(wiping.began, wiping.end)
    metrics = measure_wiping(recording, wiping.strokes, describe_wiping(wiping, cell))
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


def _strokes(node: NodeOutcome, choices: Choices) -> Iterator[Stroke]:
    """Yield from when to when each path below a node was followed, in its last run."""
    for _, path in _done(node, choices, "follow-path"):
        first, last = node.started or 0.0, inf if node.ended is None else node.ended
        yield from (run for run in choices.runs.get(path.id, []) if run[0] >= first and run[1] <= last)


def _done(
    node: NodeOutcome, choices: Mapping[int, ImplementationChosen], activity: Activity
) -> Iterator[tuple[ImplementationChosen, NodeOutcome]]:
    """Yield the calls below a node that did something and succeeded."""
    for each in node.nodes():
        choice = choices.get(each.id)
        if choice is not None and choice.activity == activity and each.status == "success":
            yield choice, each
