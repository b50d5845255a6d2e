"""Finds the wipings in a task and measures them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import inf

from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.evaluation.metrics.intervals import Interval, exclude_pauses
from skillc_runtime.evaluation.metrics.wiping import WipingSetup, measure_wiping
from skillc_runtime.evaluation.report.choice_listener import ChoiceListener
from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.primitives.primitive import Activity
from skillc_runtime.recording.events import ImplementationChosen
from skillc_runtime.recording.node_outcome import NodeOutcome
from skillc_runtime.world.space.frames import size
from skillc_runtime.world.space.surfaces import least_force_n, surface_layout
from skillc_runtime.world.state.labelled import Quantity
from skillc_runtime.world.state.labelling import label
from skillc_runtime.world.state.terms import ARM_DEVICE, SURFACE, TOOL
from skillc_runtime.world.state.world_state import WorldState

FORCE = "force"
"""The name of the force parameter, in N, of primitives that press."""


@dataclass(frozen=True, slots=True)
class Wiping:
    """A tool that was pressed with `force_n` and followed paths on a surface; `began` is the start of the skill in s.

    Between two strokes the tool was lifted. `pauses` are those since `began`. `arm` is empty if the skill has no arm
    parameter.
    """

    surface: str
    arm: str
    tool: str
    force_n: float
    began: float
    strokes: tuple[Interval, ...]
    pauses: tuple[Interval, ...] = ()

    @property
    def start(self) -> float:
        """The start of the first path in s."""
        return self.strokes[0][0]

    @property
    def undisturbed(self) -> tuple[Interval, ...]:
        """The parts of the strokes in which no pause slows the motion."""
        return exclude_pauses(self.strokes, self.pauses)

    @property
    def longest_undisturbed(self) -> Interval:
        """The longest of these parts."""
        return max(self.undisturbed, key=lambda part: part[1] - part[0])

    @property
    def end(self) -> float:
        """The end of the last path in s."""
        return self.strokes[-1][1]


def find_wipings(trees: Iterable[NodeOutcome], choices: ChoiceListener, state: WorldState) -> tuple[Wiping, ...]:
    """Return for each surface the last call with it and a tool in which paths were followed under pressure."""
    arms, found = state.instances(ARM_DEVICE), dict[str, Wiping]()
    for node in (node for tree in trees for node in tree.nodes()):
        choice = choices.get(node.id)
        individuals = [each for each in choice.individuals if each in state.individuals] if choice else []
        surfaces = [each for each in individuals if state.is_a(each, SURFACE)]
        tools = [each for each in individuals if state.is_a(each, TOOL)]
        arm = next((each for each in individuals if each in arms), "")
        forces = [choice.bindings.get(FORCE) for choice, _ in _find_activities(node, choices, "press")]
        pressed = [force.value for force in forces if isinstance(force, Quantity)]
        strokes = tuple(sorted(_find_strokes(node, choices)))
        if surfaces and tools and pressed and strokes:
            began = node.started or 0.0
            pauses = tuple(pause for pause in choices.pauses if began < pause[1] and pause[0] < strokes[-1][1])
            found[surfaces[0]] = Wiping(surfaces[0], arm, tools[0], pressed[-1], began, strokes, pauses)
    return tuple(found.values())


def wiping_setup(wiping: Wiping, state: WorldState, truth: GroundTruth) -> WipingSetup:
    """Return the true setup of a wiping, from the ground truth."""
    surface = wiping.surface
    return WipingSetup(
        surface=truth.surface_pose(surface),
        layout=surface_layout(state, surface),
        tool=size(state, wiping.tool)[:2],
        force_command_n=wiping.force_n,
        least_n=least_force_n(state, surface),
    )


def rate_wiping(wiping: Wiping, state: WorldState, truth: GroundTruth) -> WipingResult:
    """Return the quality of a wiping."""
    recording = truth.recording(wiping.tool).between(wiping.began, wiping.end)
    metrics = measure_wiping(recording, wiping.strokes, wiping_setup(wiping, state, truth), wiping.pauses)
    dwell = metrics.lane_dwell
    return WipingResult(
        surface=label(wiping.surface, state.vocabulary),
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


def _find_strokes(node: NodeOutcome, choices: ChoiceListener) -> Iterator[Interval]:
    """Yield the start and end of each path below a node, in the node's last run."""
    for _, path in _find_activities(node, choices, "follow-path"):
        first, last = node.started or 0.0, inf if node.ended is None else node.ended
        yield from (run for run in choices.runs.get(path.id, []) if run[0] >= first and run[1] <= last)


def _find_activities(
    node: NodeOutcome, choices: Mapping[int, ImplementationChosen], activity: Activity
) -> Iterator[tuple[ImplementationChosen, NodeOutcome]]:
    """Yield the successful calls below a node with an activity."""
    for each in node.nodes():
        choice = choices.get(each.id)
        if choice is not None and choice.activity == activity and each.status == "success":
            yield choice, each
