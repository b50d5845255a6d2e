"""How well a surface was wiped, judged by what really happened."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skillc_runtime.motion.layout import Layout
from skillc_runtime.motion.pose import Array, Pose, rotation_of
from skillc_runtime.simulation.coverage import PRESSED_N, CoverageMap
from skillc_runtime.simulation.dwell import LaneDwell, lane_dwell
from skillc_runtime.simulation.highpass import highpass
from skillc_runtime.simulation.recorder import Recording

LOST_N = 0.5
"""Normal force below which contact counts as lost."""

VIBRATION_HZ = 15.0
COVERAGE_PERIOD_S = 0.01


@dataclass(frozen=True, slots=True)
class Wiped:
    """What was wiped, with what: the surface's true frame in the world and layout, the tool's size (2,) m, force N."""

    surface: Pose
    layout: Layout
    tool: Array
    force_command_n: float

    @property
    def extent(self) -> Array:
        """The size (2,) of the surface."""
        return self.layout.size


@dataclass(frozen=True, slots=True)
class WipingMetrics:
    """The quality of one wiping, from the first wiping reference to the end of the last lane, at every simulation step.

    coverage: share of 5 mm cells wiped. Forces in N: mean, root mean square about the command, lost contact included,
    greatest from first contact to the start of wiping. contact_lost: share of time. Vibration of the tool above 15 Hz,
    rms in mm/s. Tilt of the tool against the true normal. Tracking: rms distance in the plane from the reference.
    lane_dwell: time lost at each corner, None where the path has none.
    """

    coverage: float
    force_command_n: float
    force_mean_n: float
    force_rmse_n: float
    contact_lost: float
    first_impact_n: float
    vibration_mm_s: float
    tilt_rms_deg: float
    tilt_max_deg: float
    tracking_mm: float
    lane_dwell: LaneDwell | None
    duration_s: float


def wiping_metrics(recording: Recording, start: float, end: float, wiped: Wiped) -> WipingMetrics:
    """Judge the wiping from `start` to `end` s of a recording that begins before the first contact.

    ValueError when nothing was recorded in between.
    """
    window, before = recording.between(start, end), recording.between(0.0, start)
    if len(window.time) < 2:
        raise ValueError(f"nothing was recorded between {start:g} and {end:g} s")
    tilt = _tilt_deg(window, wiped.surface)
    return WipingMetrics(
        coverage=coverage(window, wiped).fraction,
        force_command_n=wiped.force_command_n,
        force_mean_n=float(window.force.mean()),
        force_rmse_n=_rms(window.force - wiped.force_command_n),
        contact_lost=float((window.force < LOST_N).mean()),
        first_impact_n=float(before.force.max(initial=0.0)),
        vibration_mm_s=1000 * _vibration(window),
        tilt_rms_deg=_rms(tilt),
        tilt_max_deg=float(tilt.max()),
        tracking_mm=1000 * _tracking(window, wiped.surface),
        lane_dwell=lane_dwell(window),
        duration_s=end - start,
    )


def coverage(window: Recording, wiped: Wiped) -> CoverageMap:
    """Return the contact time of every cell of the surface, sampled at 100 Hz or more."""
    result = CoverageMap(wiped.surface, wiped.layout)
    stride = max(1, int(COVERAGE_PERIOD_S / _step(window) + 1e-6))
    seconds = stride * _step(window)
    for row in np.flatnonzero(window.force[::stride] > PRESSED_N) * stride:
        result.add(window.position[row], rotation_of(window.quaternion[row]), wiped.tool, seconds)
    return result


def _step(window: Recording) -> float:
    return float(window.time[1] - window.time[0])


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values * values)))


def _vibration(window: Recording) -> float:
    """Return the rms of the vector of high-passed tool velocity, m/s."""
    fast = highpass(window.velocity, VIBRATION_HZ, _step(window))
    return _rms(np.linalg.norm(fast, axis=1))


def _tilt_deg(window: Recording, surface: Pose) -> Array:
    """Return the angle (n,) between the tool's z axis and the surface's -n."""
    w, x, y, z = window.quaternion.T
    axis = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], axis=1)
    normal = surface.rotation[:, 2]
    sine = np.linalg.norm(np.cross(axis, normal), axis=1)
    return np.asarray(np.degrees(np.arctan2(sine, -axis @ normal)))


def _tracking(window: Recording, surface: Pose) -> float:
    """Return the rms distance in the plane of the surface between tool and reference, m."""
    in_plane = (window.position - window.reference) @ surface.rotation[:, :2]
    return _rms(np.linalg.norm(in_plane, axis=1))
