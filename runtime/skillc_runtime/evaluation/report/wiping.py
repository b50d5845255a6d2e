"""Finds the wipings in a task, measures them, and makes the data for their figure."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.devices.ground_truth import GroundTruth, Recording, join_recordings
from skillc_runtime.evaluation.metrics.intervals import Interval, exclude_pauses, exclude_standstill
from skillc_runtime.evaluation.metrics.lane_dwell import DWELL_SHARE, find_lane_velocity
from skillc_runtime.evaluation.metrics.wiping import WipingSetup, measure_coverage, measure_wiping
from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.motion.dirt_map import DIRTY, resample
from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.primitive import Activity
from skillc_runtime.recording.history.history import RecordedCall, RunHistory
from skillc_runtime.world.space.dirt import read_dirt_map
from skillc_runtime.world.space.frames import size
from skillc_runtime.world.space.surfaces import least_force_n, surface_layout
from skillc_runtime.world.state.labels.labelled import LabelledQuantity, display_name
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import ARM_DEVICE, SURFACE, TOOL
from skillc_runtime.world.state.world_state import WorldState

FORCE = "force"
"""The name of the force parameter, in N, of primitives that press."""

DECIMATION = 5
"""One of this many simulation steps is drawn."""

LEAST_ROWS = 16
"""Fewer rows show no oscillation."""

STANDING_M_S = 1e-3
"""A slower path has no direction."""


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


def find_recorded_wipings(history: RunHistory, state: WorldState, truth: GroundTruth | None) -> tuple[Wiping, ...]:
    """Return the wipings of which something can be said: not those of a tool that was lost before."""
    found = find_wipings(history, state)
    return tuple(each for each in found if truth is None or _is_recorded(each, truth.recording(each.tool)))


def _is_recorded(wiping: Wiping, recording: Recording) -> bool:
    return any(len(recording.between(*each).time) > 1 for each in wiping.undisturbed)


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
    pressed = [force.value for force in forces if isinstance(force, LabelledQuantity)]
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
        clean=truth.coverage(surface).clean,
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


class WipingDrawing(msgspec.Struct, frozen=True):
    """One wiping; times in s from its first reference, positions in mm from the middle of the surface, names as words.

    extent (2,): size of the surface; `covered`: share of it that was wiped. dose (rows along y, columns along x):
    contact time of the cells in s. lanes (n, 2): the commanded path without overlays; tool (n, 2): the measured path.
    time (n,): of lanes, tool and speeds; lane_speed, tool_speed (n,): mm/s along the path; `overlay_period_s`: of the
    overlay, None without one. contact_time, force (m,): s and N from the approach on; `force_n` is the commanded force.
    While paused, nothing but the force is drawn. `spared`: which cells are not to be wiped, `seen_dirty`: which the
    last inspection of the run showed dirty, as `dose`; None for none. `before`: share that had been clean before.
    """

    surface: str
    robot: str
    extent: Array
    covered: float
    dose: Array
    lanes: Array
    tool: Array
    time: Array
    lane_speed: Array
    tool_speed: Array
    overlay_period_s: float | None
    contact_time: Array
    force: Array
    force_n: float
    pauses: tuple[Interval, ...] = ()
    spared: NDArray[np.bool_] | None = None
    seen_dirty: NDArray[np.bool_] | None = None
    before: float = 0.0

    @property
    def step_s(self) -> float:
        """The time between two rows, s."""
        return float(np.nanmedian(np.diff(self.time))) if len(self.time) > 1 else 1.0

    @property
    def dwell_speed(self) -> float:
        """The speed below which a tool dwells, mm/s."""
        return DWELL_SHARE * float(np.nanmax(self.lane_speed, initial=0.0))


def make_wiping_drawing(wiping: Wiping, state: WorldState, truth: GroundTruth) -> WipingDrawing:
    """Return the drawing of one wiping."""
    recording = truth.recording(wiping.tool).between(wiping.began, wiping.end)
    setup = wiping_setup(wiping, state, truth)
    moving, frame = exclude_standstill(wiping.strokes, wiping.pauses), setup.surface.inverse()
    windows = [recording.between(*each) for each in moving]
    window, rows_drawn = join_recordings(windows), _join_strokes(windows)
    covered, dirt = measure_coverage(window, setup), read_dirt_map(state, wiping.surface)

    def on_surface(points: Array) -> Array:
        return np.asarray(1e3 * (points @ frame.rotation.T + frame.position)[:, :2])

    return WipingDrawing(
        surface=display_name(wiping.surface),
        robot=display_name(wiping.arm),
        extent=1e3 * setup.extent,
        covered=covered.wiped_share,
        dose=covered.dose,
        spared=~covered.mask | covered.clean,
        seen_dirty=None if dirt is None else resample(dirt, covered.x, covered.y, covered.size) == DIRTY,
        before=float(covered.clean[covered.mask].mean()) if covered.mask.any() else 0.0,
        lanes=on_surface(rows_drawn.path),
        tool=on_surface(rows_drawn.position),
        time=rows_drawn.time - wiping.start,
        lane_speed=1e3 * np.linalg.norm(rows_drawn.path_velocity, axis=1),
        tool_speed=1e3 * _component_along(rows_drawn.path_velocity, rows_drawn.velocity),
        overlay_period_s=find_overlay_period(window) if find_lane_velocity(window)[1] == "path" else None,
        contact_time=recording.time[::DECIMATION] - wiping.start,
        force=recording.force[::DECIMATION],
        force_n=wiping.force_n,
        pauses=tuple((start - wiping.start, end - wiping.start) for start, end in wiping.pauses),
    )


def _join_strokes(windows: Sequence[Recording]) -> Recording:
    """Return the rows of strokes to draw, with a row of NaN between strokes, so that no line joins them."""
    rows = [each.rows[::DECIMATION] for each in windows]
    gap = np.full((1, rows[0].shape[1]), np.nan)
    return Recording(np.concatenate([part for each in rows for part in (each, gap)][:-1]))


def find_overlay_period(window: Recording) -> float | None:
    """Return the period in s of the strongest oscillation of an overlay; None if too little was recorded."""
    overlay = (window.reference - window.path)[::DECIMATION]
    if len(overlay) < LEAST_ROWS:
        return None
    swing = (overlay - overlay.mean(axis=0)) * np.hanning(len(overlay))[:, None]
    strength = np.linalg.norm(np.fft.rfft(swing, axis=0), axis=1)
    step_s = float(np.median(np.diff(window.time))) * DECIMATION
    return len(overlay) * step_s / (1 + int(strength[1:].argmax()))


def _component_along(path_velocity: Array, velocity: Array) -> Array:
    """Return the component (n,) of a velocity (n, 3) along a path; its magnitude where the path stands still."""
    speed = np.linalg.norm(path_velocity, axis=1)
    along = np.einsum("ij,ij->i", velocity, path_velocity) / np.maximum(speed, STANDING_M_S)
    return np.asarray(np.where(speed > STANDING_M_S, along, np.linalg.norm(velocity, axis=1)))
