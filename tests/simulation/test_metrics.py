"""Metrics of recordings that are made up, so that the right answer is known."""

import numpy as np
import pytest

from skillc_runtime.backends.simulation.truth.recorder import COLUMNS, ToolRecorder, put_reference, record
from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.evaluation.metrics.wiping import WipingSetup, filter_high_pass, measure_wiping
from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.layout import Layout
from skillc_runtime.motion.pose import Pose, exp, quaternion_from_rotation

SURFACE = Pose.of((1.0, 2.0, 0.5), (0.5, 0.5, -0.5, -0.5))
EXTENT, TOOL = np.array([0.40, 0.30]), np.array([0.10, 0.05])
INTO = np.diag([1.0, -1.0, -1.0])
STEP_S = 0.001
LEAST_N = 5.0


def recording(local: np.ndarray, force: np.ndarray, tilt_rad: float = 0.0) -> Recording:
    """Return a tool whose middle is at `local` (n, 2) of the surface, pressed with `force` (n,), from time 0."""
    rows = np.zeros((len(local), COLUMNS))
    rows[:, 0], rows[:, 1], rows[:, 24] = np.arange(len(local)) * STEP_S, force, force
    placed = np.column_stack([local, np.zeros(len(local))])
    for first in (2, 12, 18):
        rows[:, first : first + 3] = placed @ SURFACE.rotation.T + SURFACE.position
    rows[:, 5:9] = quaternion_from_rotation(SURFACE.rotation @ INTO @ exp(np.array([tilt_rad, 0.0, 0.0])))
    for first in (9, 15, 21):
        rows[:, first : first + 3] = np.gradient(rows[:, 2:5], STEP_S, axis=0)
    return Recording(rows)


def lane(offset: float, count: int = 3000) -> np.ndarray:
    return np.column_stack([np.linspace(-0.2, 0.2, count), np.full(count, offset)])


def wiped(force: float = 10.0) -> WipingSetup:
    return WipingSetup(SURFACE, Layout(EXTENT), TOOL, force, LEAST_N)


def test_one_lane_covers_its_share_of_the_surface() -> None:
    local = lane(0.0)
    metrics = measure_wiping(recording(local, np.full(len(local), 10.0)), [(0.0, 3.0)], wiped())
    assert metrics.coverage == pytest.approx(0.05 / 0.30)
    assert metrics.force_mean_n == 10.0
    assert metrics.force_rmse_n == 0.0
    assert metrics.contact_lost == 0.0
    assert metrics.tracking_mm == pytest.approx(0.0, abs=1e-9)
    assert metrics.tilt_max_deg == pytest.approx(0.0, abs=1e-5)


def test_what_is_not_pressed_is_not_wiped_and_counts_as_lost() -> None:
    local = lane(0.0)
    force = np.where(np.arange(len(local)) < len(local) // 2, 10.0, 0.2)
    metrics = measure_wiping(recording(local, force), [(0.0, 3.0)], wiped())
    assert metrics.contact_lost == pytest.approx(0.5)
    assert metrics.coverage == pytest.approx(0.05 / 0.30 * 0.625, rel=0.02)
    assert metrics.force_rmse_n == pytest.approx(9.8 / np.sqrt(2), rel=0.01)


def test_all_lanes_cover_all() -> None:
    local = np.concatenate([lane(offset) for offset in np.arange(-0.14, 0.141, 0.04)])
    metrics = measure_wiping(recording(local, np.full(len(local), 10.0)), [(0.0, 100.0)], wiped())
    assert metrics.coverage == 1.0


def test_tilt_and_tracking_are_those_of_the_tool() -> None:
    local = lane(0.0)
    made = recording(local, np.full(len(local), 10.0), tilt_rad=np.radians(2.0))
    rows = made.rows.copy()
    rows[:, 12:15] += 0.003 * SURFACE.rotation[:, 0] + 0.5 * SURFACE.rotation[:, 2]
    metrics = measure_wiping(Recording(rows), [(0.0, 3.0)], wiped())
    assert metrics.tilt_rms_deg == pytest.approx(2.0, rel=1e-6)
    assert metrics.tracking_mm == pytest.approx(3.0, rel=1e-6), "only what lies in the plane counts"


def test_the_first_impact_lies_before_the_window() -> None:
    local = lane(0.0)
    force = np.full(len(local), 10.0)
    force[500] = 17.0
    force[2000] = 40.0
    assert measure_wiping(recording(local, force), [(1.0, 3.0)], wiped()).first_impact_n == 17.0


def test_vibration_above_15_hz_counts_and_slower_motion_does_not() -> None:
    time = np.arange(4000) * STEP_S
    slow, fast = np.sin(2 * np.pi * 1.0 * time), 0.002 * np.sin(2 * np.pi * 60.0 * time)
    for signal, expected in ((slow, 0.0), (slow + fast, 1000 * 0.002 / np.sqrt(2))):
        made = recording(np.zeros((4000, 2)), np.full(4000, 10.0))
        rows = made.rows.copy()
        rows[:, 9] = signal
        assert measure_wiping(Recording(rows), [(0.0, 4.0)], wiped()).vibration_mm_s == pytest.approx(
            expected, abs=0.05
        )


def test_the_high_pass_is_a_butterworth_run_both_ways() -> None:
    from scipy.signal import butter, sosfiltfilt  # its import takes a second, which each process of tests would pay

    signal = np.cumsum(np.random.default_rng(2).normal(size=(3000, 3)), axis=0)
    sections = butter(4, 15.0, "highpass", fs=1000.0, output="sos")
    expected = sosfiltfilt(sections, signal, axis=0)
    ours = filter_high_pass(signal, 15.0, STEP_S)
    middle = slice(500, -500)
    np.testing.assert_allclose(ours[middle], expected[middle], atol=1e-6 * np.abs(signal).max())


def test_an_empty_window_is_refused() -> None:
    local = lane(0.0)
    with pytest.raises(ValueError, match="nothing was recorded"):
        measure_wiping(recording(local, np.ones(len(local))), [(10.0, 20.0)], wiped())


def test_a_turned_tool_wipes_what_it_covers() -> None:
    turned = exp(np.array([0.0, 0.0, 0.6]))
    coverage = CoverageMap(SURFACE, Layout(EXTENT), LEAST_N)
    coverage.add(SURFACE.position, SURFACE.rotation @ turned @ INTO, TOOL, 0.01)
    x, y = np.meshgrid(coverage.x, coverage.y)
    u, v = np.cos(0.6) * x + np.sin(0.6) * y, np.cos(0.6) * y - np.sin(0.6) * x
    expected = (np.abs(u) <= 0.05) & (np.abs(v) <= 0.025)
    assert expected.any()
    np.testing.assert_array_equal(coverage.dose > 0, expected)


def test_of_strokes_with_lifts_between_them_only_what_is_wiped_counts() -> None:
    local = lane(0.0, 4000)
    force = np.full(len(local), 10.0)
    force[1000:3000], force[1500] = 0.0, 25.0
    whole = measure_wiping(recording(local, force), [(0.0, 4.0)], wiped())
    parted = measure_wiping(recording(local, force), [(0.0, 1.0), (3.0, 4.0)], wiped())
    assert whole.contact_lost == pytest.approx(0.5, abs=0.001)
    assert parted.contact_lost == 0.0
    assert parted.force_mean_n == 10.0
    assert parted.first_impact_n == 25.0
    assert parted.duration_s == 2.0
    assert parted.coverage == pytest.approx((0.05 / 0.30) * 0.75, abs=0.001)


def test_a_recording_keeps_all_steps_and_references_when_its_room_is_doubled() -> None:
    truth, reference, count = np.zeros(11), np.full((8, 3), 2.0), np.zeros(1)
    recorder = ToolRecorder(truth, expected_steps=2)
    steps, sampled = recorder.make_memory(), recorder.make_references(reference, reference, SURFACE, count, count)
    for number in range(9):
        truth[:] = number
        if not record(steps, float(number)):
            steps = recorder.make_memory()
            sampled = recorder.make_references(reference, reference, SURFACE, count, count)
            assert record(steps, float(number))
        put_reference(sampled, float(number))
    made = recorder.recording()
    assert made.time.tolist() == made.force.tolist() == [*range(9)]
    assert made.position[:, 2].tolist() == [*range(9)]
    assert made.reference == pytest.approx(np.tile(SURFACE.apply(np.full(3, 2.0)), (9, 1)))
