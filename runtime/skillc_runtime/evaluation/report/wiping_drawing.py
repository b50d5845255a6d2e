"""The data for the figure of one wiping: commanded and measured paths, contact times, speeds and forces."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.devices.ground_truth import GroundTruth, Recording, join_recordings
from skillc_runtime.evaluation.metrics.intervals import Interval, exclude_standstill
from skillc_runtime.evaluation.metrics.lane_dwell import DWELL_SHARE, find_lane_velocity
from skillc_runtime.evaluation.metrics.wiping import measure_coverage
from skillc_runtime.evaluation.report.wiping import Wiping, wiping_setup
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.labels.labelled import display_name
from skillc_runtime.world.state.world_state import WorldState

DECIMATION = 5
"""One of this many simulation steps is drawn."""

LEAST_ROWS = 16
"""Fewer rows show no oscillation."""

STANDING_M_S = 1e-3
"""A slower path has no direction."""


class WipingDrawing(msgspec.Struct, frozen=True):
    """One wiping; times in s from its first reference, positions in mm from the middle of the surface, names as words.

    extent (2,): size of the surface; `covered`: share of it that was wiped. dose (rows along y, columns along x):
    contact time of the cells in s. lanes (n, 2): the commanded path without overlays; tool (n, 2): the measured path.
    time (n,): of lanes, tool and speeds; lane_speed, tool_speed (n,): mm/s along the path; `overlay_period_s`: of the
    overlay, None without one. contact_time, force (m,): s and N from the approach on; `force_n` is the commanded force.
    While paused, nothing but the force is drawn. `spared`: which cells are not to be wiped, as `dose`; None for none.
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
    covered = measure_coverage(window, setup)

    def on_surface(points: Array) -> Array:
        return np.asarray(1e3 * (points @ frame.rotation.T + frame.position)[:, :2])

    return WipingDrawing(
        surface=display_name(wiping.surface),
        robot=display_name(wiping.arm),
        extent=1e3 * setup.extent,
        covered=covered.wiped_share,
        dose=covered.dose,
        spared=~covered.mask,
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
