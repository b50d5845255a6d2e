"""What is commanded stands beside what is measured: the force of a push, and the velocity of the tool."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from recording.runs import CONTENTS
from simulation.cells import ARM, world
from skillc.cells.samples import Sampler
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.motion.pose import Array
from skillc_runtime.recording.mcap.reader import SignalTable, read_recording
from skillc_runtime.recording.mcap.recording_file import RecordingFile
from skillc_runtime.recording.mcap.signal_tap import RecordedCell, SignalTap
from skillc_runtime.recording.signals.channels import name_devices
from skillc_runtime.recording.signals.sampler import SignalSampler
from skillc_runtime.recording.signals.signal import Signal
from skillc_runtime.world.state.model import WorldModel

FORCE_N, STILL_S, PUSHES_S = 3.0, 0.2, 0.6
PUSHES = np.array([0.0, 0.0, 1.0])


class Rows:
    """A sink that keeps its rows."""

    def __init__(self) -> None:
        self.rows: list[Array] = []

    def write(self, row: Array) -> None:
        self.rows.append(row.copy())

    def close(self) -> None:
        pass


def vectors(table: SignalTable, name: str, unit: str) -> Array:
    """Return the samples (n, 3) of the vector whose columns begin like this."""
    return np.column_stack([table.column(f"{name}{axis}_{unit}") for axis in "xyz"])


@pytest.mark.slow
@pytest.mark.parametrize("scene", ["iiwa_table", "ur5e_whiteboard"])
def test_a_push_and_the_velocity_of_the_tool_are_recorded_sampled_and_shown_alike(scene: str, tmp_path: Path) -> None:
    cell = SimulatedCell(WorldModel(world(scene)), 0)
    arm, iri = cell.arm(ARM[scene]), ARM[scene]
    name = name_devices(cell.world.snapshot())[iri]
    tap = SignalTap(cell.capabilities.live)
    signals = tap.layout.describe(lambda each: name_devices(cell.world.snapshot())[each])
    recording = RecordingFile(tmp_path / "a.mcap", lambda: CONTENTS, RecordedCell(tap, signals, None))
    recording.sample()
    rows = Rows()
    sampler, live = SignalSampler(cell, lambda signals: rows), Sampler("cell", cell)
    cell.advance(STILL_S)
    assert live.take().arms[iri].commanded_force is None
    arm.compliance.release(PUSHES)
    arm.compliance.push(PUSHES, FORCE_N)
    cell.advance(PUSHES_S)
    sampler.sample()
    shown = live.take().arms[iri]
    recording.close()

    table = read_recording(tmp_path / "a.mcap").signals()
    force, speed = vectors(table, f"{name}/command/force_", "n"), vectors(table, f"{name}/estimate/tool_v", "m_s")
    pushing = np.isfinite(force).all(axis=1)
    assert abs(table.time_s[pushing][0] - STILL_S) < 0.01 and (np.diff(np.flatnonzero(pushing)) == 1).all()
    assert pushing[-1] and np.isnan(force[~pushing]).all()
    length = np.linalg.norm(force[pushing], axis=1)
    assert length[0] < 0.1 * FORCE_N and (np.diff(length) > -2e-3).all(), "the ramp"
    np.testing.assert_allclose(force[-1], FORCE_N * PUSHES, atol=0.02)
    np.testing.assert_allclose(shown.commanded_force, force[-1], atol=2e-3)
    np.testing.assert_allclose(shown.velocity, speed[-1], atol=2e-4)
    assert np.linalg.norm(speed[-1]) > 0.005, "it moves"

    sampled: dict[Signal, float] = dict(zip(sampler.signals, rows.rows[-1].tolist(), strict=True))
    of = {each.column: value for each, value in sampled.items()}
    assert [of[f"{name}/command/force_{axis}_n"] for axis in "xyz"] == pytest.approx(force[-1].tolist(), abs=2e-3)
