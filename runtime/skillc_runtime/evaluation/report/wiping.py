"""Finds the wipings in a task and measures them."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.evaluation.metrics.intervals import Interval, exclude_pauses
from skillc_runtime.evaluation.metrics.wiping import WipingSetup, measure_wiping
from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.primitives.primitive import Activity
from skillc_runtime.recording.history.history import RecordedCall, RunHistory
from skillc_runtime.world.space.frames import size
from skillc_runtime.world.space.surfaces import least_force_n, surface_layout
from skillc_runtime.world.state.labels.labelled import Quantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import ARM_DEVICE, SURFACE, TOOL
from skillc_runtime.world.state.world_state import WorldState

FORCE = "force"
"""The name of the force parameter, in N, of primitives that press."""


class Wiping(msgspec.Struct, frozen=True):
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


def find_wipings(history: RunHistory, state: WorldState) -> tuple[Wiping, ...]:
    """Return in order of time the innermost calls with a surface and a tool that follow paths under pressure."""
    found = (wiping for step in history.steps for wiping in _find_below(step, history, state))
    return tuple(sorted(found, key=lambda wiping: wiping.began))


def _find_below(call: RecordedCall, history: RunHistory, state: WorldState) -> list[Wiping]:
    """Return the wipings in a call: those of the calls inside, else its own."""
    return [each for inner in call.calls for each in _find_below(inner, history, state)] or list(
        _make_wiping(call, history, state)
    )


def _make_wiping(call: RecordedCall, history: RunHistory, state: WorldState) -> Iterator[Wiping]:
    """Yield what a call has wiped, if it names a surface and a tool and paths were followed under pressure in it."""
    individuals = [each for each in call.individuals if each in state.individuals]
    surfaces = [each for each in individuals if state.is_a(each, SURFACE)]
    tools = [each for each in individuals if state.is_a(each, TOOL)]
    forces = [each.bindings.get(FORCE) for each in _find_activities(call, "press")]
    pressed = [force.value for force in forces if isinstance(force, Quantity)]
    followed = _find_activities(call, "follow-path")
    strokes = tuple(
        (each.started, each.ended) for each in followed if each.started is not None and each.ended is not None
    )
    if not (surfaces and tools and pressed and strokes):
        return
    arms, began = state.instances(ARM_DEVICE), call.started or 0.0
    arm = next((each for each in individuals if each in arms), "")
    pauses = tuple(pause for pause in history.paused if began < pause[1] and pause[0] < strokes[-1][1])
    yield Wiping(surfaces[0], arm, tools[0], pressed[-1], began, strokes, pauses)


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
        start_s=wiping.start,
        end_s=wiping.end,
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


def _find_activities(call: RecordedCall, activity: Activity) -> list[RecordedCall]:
    """Return the successful calls with an activity in a call, in order of time."""
    found = (each for each in call.all if each.activity == activity and each.status == "success")
    return sorted(found, key=lambda each: each.started or 0.0)
