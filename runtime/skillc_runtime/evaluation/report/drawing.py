"""What is drawn of one wiping: where the tool should go and went, how long it was where, how fast and how hard."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.ground_truth import Recording, join_recordings
from skillc_runtime.evaluation.metrics.lane_dwell import LINGERING, along_lanes
from skillc_runtime.evaluation.metrics.wiping import measure_coverage
from skillc_runtime.evaluation.report.wiping import Wiping, describe_wiping
from skillc_runtime.motion.pose import Array

EVERY = 5
"""Of so many steps one is drawn."""

STANDING_M_S = 1e-3
"""A path that is slower has no direction."""


@dataclass(frozen=True, slots=True)
class Drawing:
    """One wiping, seconds counted from its first reference, places in mm from the middle of the surface.

    extent (2,): size of the surface; `covered` is the share of it that was wiped. dose (rows along y, columns along x):
    contact time of cells in s. lanes (n, 2): the path that was asked for, without overlays; tool (n, 2): what became
    of it. time (n,): of lanes, tool and speeds; lane_speed, tool_speed (n,): mm/s along the path; `overlaid` tells
    whether an overlay was added. contact_time, force (m,): s and N from the approach on, `force_n` was asked for.
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
    overlaid: bool
    contact_time: Array
    force: Array
    force_n: float

    @property
    def lingering(self) -> float:
        """The speed below which a tool dwells, mm/s."""
        return LINGERING * float(np.nanmax(self.lane_speed, initial=0.0))


def make_drawing(wiping: Wiping, cell: SimulatedCell) -> Drawing:
    """Gather what is drawn of one wiping."""
    recording, wiped = (
        cell.ground_truth.recording(wiping.tool).between(wiping.began, wiping.end),
        describe_wiping(wiping, cell),
    )
    windows, frame = [recording.between(*stroke) for stroke in wiping.strokes], wiped.surface.inverse()
    window, drawn = join_recordings(windows), _apart(windows)
    covered = measure_coverage(window, wiped)

    def on_surface(points: Array) -> Array:
        return np.asarray(1e3 * (points @ frame.rotation.T + frame.position)[:, :2])

    short = cell.world.snapshot().vocabulary.short
    return Drawing(
        surface=short(wiping.surface),
        robot=short(wiping.arm),
        extent=1e3 * wiped.extent,
        covered=covered.wiped_share,
        dose=covered.dose,
        lanes=on_surface(drawn.path),
        tool=on_surface(drawn.position),
        time=drawn.time - wiping.start,
        lane_speed=1e3 * np.linalg.norm(drawn.path_velocity, axis=1),
        tool_speed=1e3 * _along(drawn.path_velocity, drawn.velocity),
        overlaid=along_lanes(window)[1] == "path",
        contact_time=recording.time[::EVERY] - wiping.start,
        force=recording.force[::EVERY],
        force_n=wiping.force_n,
    )


def _apart(windows: Sequence[Recording]) -> Recording:
    """Return what is drawn of strokes, with a row of no numbers after each, so that no line leads to the next."""
    rows = [each.rows[::EVERY] for each in windows]
    gap = np.full((1, rows[0].shape[1]), np.nan)
    return Recording(np.concatenate([part for each in rows for part in (each, gap)][:-1]))


def _along(path_velocity: Array, velocity: Array) -> Array:
    """Return the part (n,) of a velocity (n, 3) that is along a path; all of it where the path stands."""
    speed = np.linalg.norm(path_velocity, axis=1)
    along = np.einsum("ij,ij->i", velocity, path_velocity) / np.maximum(speed, STANDING_M_S)
    return np.asarray(np.where(speed > STANDING_M_S, along, np.linalg.norm(velocity, axis=1)))
