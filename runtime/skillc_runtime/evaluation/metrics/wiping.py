"""The quality of wiping, from the ground truth of the simulation."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.devices.ground_truth import Recording, join_recordings
from skillc_runtime.evaluation.metrics.intervals import Interval, exclude_pauses, exclude_standstill, total_s
from skillc_runtime.evaluation.metrics.lane_dwell import LaneDwell, measure_lane_dwell
from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.layout import Layout
from skillc_runtime.motion.pose import Array, Pose, rotation_from_quaternion

LOST_N = 0.5
"""Normal force below which contact counts as lost."""

VIBRATION_HZ = 15.0
COVERAGE_PERIOD_S = 0.01


class WipingSetup(msgspec.Struct, frozen=True):
    """The true pose of the surface in the world and its layout, the tool's size (2,) in m, the commanded force in N.

    `least_n` is the least force in N with which a tool wipes the surface; `clean` (rows, columns) are the cells that
    had been clean before anything was wiped, None for none.
    """

    surface: Pose
    layout: Layout
    tool: Array
    force_command_n: float
    least_n: float
    clean: NDArray[np.bool_] | None = None

    @property
    def extent(self) -> Array:
        """The size (2,) of the surface in m."""
        return self.layout.size


class WipingMetrics(msgspec.Struct, frozen=True):
    """The quality of one wiping, from the first wiping reference to the end of the last lane, at every simulation step.

    Pauses are left out, but for the coverage and the greatest force.
    coverage: share of the 5 mm cells that were wiped, or had been clean before. Forces in N: mean, rms error about the
    command (with lost contact), and the greatest outside the strokes, while the tool is put down. contact_lost: share
    of the time.
    Vibration of the tool above 15 Hz, rms in mm/s. Tilt of the tool against the true normal in degrees. Tracking: rms
    distance from the reference in the plane, in mm. lane_dwell: of the worst stroke, None if the path has no corner.
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


def measure_wiping(
    recording: Recording, strokes: Sequence[Interval], setup: WipingSetup, pauses: Sequence[Interval] = ()
) -> WipingMetrics:
    """Measure the wiping in all strokes, without pauses, of a recording that begins before the first contact.

    A stroke is a motion over the surface without lifting the tool, but for pauses. Coverage includes what is wiped
    while a pause begins and ends. ValueError if nothing was recorded.
    """
    wiping = exclude_pauses(strokes, pauses)
    windows = [window for each in wiping if len((window := recording.between(*each)).time) > 1]
    if not windows:
        times = ", ".join(f"{start:g} to {end:g} s" for start, end in strokes)
        raise ValueError(f"nothing was recorded from {times}")
    window, outside = join_recordings(windows), recording.without(wiping)
    moving = join_recordings([recording.between(*each) for each in exclude_standstill(strokes, pauses)])
    tilt = _tilt_deg(window, setup.surface)
    return WipingMetrics(
        coverage=measure_coverage(moving, setup).wiped_share,
        force_command_n=setup.force_command_n,
        force_mean_n=float(window.force.mean()),
        force_rmse_n=_rms(window.force - setup.force_command_n),
        contact_lost=float((window.force < LOST_N).mean()),
        first_impact_n=float(outside.force.max(initial=0.0)),
        vibration_mm_s=1000 * _vibration_m_s(windows),
        tilt_rms_deg=_rms(tilt),
        tilt_max_deg=float(tilt.max()),
        tracking_mm=1000 * _tracking_error_m(window, setup.surface),
        lane_dwell=max(filter(None, map(measure_lane_dwell, windows)), key=lambda dwell: dwell.seconds, default=None),
        duration_s=total_s(wiping),
    )


def measure_coverage(window: Recording, setup: WipingSetup) -> CoverageMap:
    """Return the contact time in s of every cell of the surface, sampled at 100 Hz or more."""
    result = CoverageMap(setup.surface, setup.layout, setup.least_n)
    if setup.clean is not None:
        result.clean[:] = setup.clean
    stride = max(1, int(COVERAGE_PERIOD_S / _step_s(window) + 1e-6))
    seconds = stride * _step_s(window)
    for row in np.flatnonzero(window.on_surface[::stride] >= setup.least_n) * stride:
        result.add(window.position[row], rotation_from_quaternion(window.quaternion[row]), setup.tool, seconds)
    return result


def _step_s(window: Recording) -> float:
    return float(window.time[1] - window.time[0])


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values * values)))


def _vibration_m_s(windows: Sequence[Recording]) -> float:
    """Return the rms of the magnitude of the high-pass filtered tool velocity, in m/s."""
    fast = [filter_high_pass(window.velocity, VIBRATION_HZ, _step_s(window)) for window in windows]
    return _rms(np.linalg.norm(np.concatenate(fast), axis=1))


def _tilt_deg(window: Recording, surface: Pose) -> Array:
    """Return the angle (n,) in degrees between the tool's z axis and the negative normal of the surface."""
    w, x, y, z = window.quaternion.T
    axis = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], axis=1)
    normal = surface.rotation[:, 2]
    sine = np.linalg.norm(np.cross(axis, normal), axis=1)
    return np.asarray(np.degrees(np.arctan2(sine, -axis @ normal)))


def _tracking_error_m(window: Recording, surface: Pose) -> float:
    """Return the rms distance between tool and reference in the plane of the surface, in m."""
    in_plane = (window.position - window.reference) @ surface.rotation[:, :2]
    return _rms(np.linalg.norm(in_plane, axis=1))


FILTER_ORDER = 4


def filter_high_pass(signal: Array, cutoff_hz: float, step_s: float) -> Array:
    """Return the columns of `signal` (n, k) without the frequencies below the cutoff.

    Running the digital Butterworth filter (bilinear transform) forward and backward multiplies the spectrum by
    |H|^2 = 1 / (1 + (tan(pi fc h) / tan(pi f h))^2N). The signal is continued antisymmetrically at both ends.
    """
    margin = min(len(signal) - 1, int(3 / (cutoff_hz * step_s)))
    head, tail = 2 * signal[0] - signal[margin:0:-1], 2 * signal[-1] - signal[-2 : -margin - 2 : -1]
    padded = np.concatenate([head, signal, tail])
    spectrum = np.fft.rfft(padded, axis=0)
    half_angle = np.pi * np.fft.rfftfreq(len(padded), step_s) * step_s
    gain = np.zeros_like(half_angle)
    gain[1:] = 1 / (1 + (np.tan(np.pi * cutoff_hz * step_s) / np.tan(half_angle[1:])) ** (2 * FILTER_ORDER))
    filtered = np.fft.irfft(spectrum * gain[:, None], len(padded), axis=0)
    return np.asarray(filtered[margin : margin + len(signal)])
