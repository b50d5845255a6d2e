"""A device with its own time: its samples have the times of the cell, and the device's own stamps beside them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from recording.runs import CONTENTS
from skillc_runtime.devices.live import LiveArm, LiveSignals
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.recording.mcap.reader import SignalTable, read_recording
from skillc_runtime.recording.mcap.recording_file import RecordingFile
from skillc_runtime.recording.mcap.signal_tap import RecordedCell, SignalTap

PERIOD_S, AHEAD_S, FASTER = 0.002, 1000.0, 1.001


class Device:
    """An arm of one joint, whose clock is elsewhere and faster; the angle says when it was measured."""

    def __init__(self) -> None:
        self.now, self.measured = 0.0, np.zeros((2, 1))
        self.live = LiveSignals(
            PERIOD_S,
            lambda: self.now,
            (
                LiveArm(
                    individual="arm",
                    joints=1,
                    measured=self.measured.tobytes,
                    wrench=None,
                    reference=np.full((8, 3), np.nan).tobytes,
                    base=lambda: Pose(np.zeros(3), np.eye(3)),
                    stamp=lambda: np.array([AHEAD_S + FASTER * self.now]).tobytes(),
                ),
            ),
        )

    def sample(self, now: float) -> None:
        self.now = now
        self.measured[0, 0] = now
        for listen in self.live.listeners:
            listen()


def record(file: Path, times: Array) -> SignalTable:
    device = Device()
    tap = SignalTap(device.live)
    cell = RecordedCell(tap, tap.layout.describe(lambda name: name), None)
    recording = RecordingFile(file, lambda: CONTENTS, cell)
    recording.sample()
    for now in times.tolist():
        device.sample(now)
    recording.close()
    assert recording.problem is None
    return read_recording(file).signals()


def late_at_times() -> Iterator[float]:
    """Yield times a period apart, of which some are late, one by a second, and two are lost."""
    now, rng = 0.0, np.random.default_rng(3)
    for number in range(3000):
        now += PERIOD_S * (3 if number in (700, 1400) else 1) + (1.0 if number == 2000 else 0.0)
        yield now + float(rng.uniform(0.0, 2e-4))


@pytest.mark.parametrize("times", [np.arange(1, 1000) * PERIOD_S, np.array(list(late_at_times()))])
def test_times_are_those_of_the_cell_and_stamps_those_of_the_device(tmp_path: Path, times: Array) -> None:
    table = record(tmp_path / "a.mcap", times)
    assert len(table.time_s) == len(times)
    np.testing.assert_allclose(table.column("arm/sensor/joint_1_rad"), times, atol=1e-5)
    np.testing.assert_allclose(table.column("arm/sensor/measured_s"), AHEAD_S + FASTER * times, atol=1e-5)
    wrong = np.abs(table.time_s - times)
    assert np.quantile(wrong, 0.98) < PERIOD_S
    assert (np.diff(table.time_s) > 0).all()
