"""Signals of a cell as CSV and Parquet: what the columns say is so, and pandas reads it."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest
from click.testing import CliRunner

from simulation.cells import ARM, GRIPPER, world
from skillc.cli.main import skillc
from skillc.errors import RequestError
from skillc.services.run.signal_files import SignalFormat, check_signals, recorded_signals
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.backend import Backend
from skillc_runtime.motion.pose import Array, quaternion_from_rotation
from skillc_runtime.recording.signals.sampler import SignalSampler
from skillc_runtime.recording.signals.signal import Signal
from skillc_runtime.world.state.model import WorldModel

SCENE = "iiwa_table"
TICKS = 5


class Talk:
    """A reporter that keeps what it is told."""

    def __init__(self) -> None:
        self.said: list[str] = []

    def say(self, text: str) -> None:
        self.said.append(text)


def record(cell: Backend, form: SignalFormat, folder: Path) -> None:
    with recorded_signals(cell, form, folder, Talk()) as hooks:  # type: ignore[arg-type]
        for _ in range(TICKS):
            cell.advance(0.01)
            for hook in hooks:
                hook()


def test_both_formats_have_the_same_values_which_are_those_of_the_cell(tmp_path: Path) -> None:
    cell = SimulatedCell(WorldModel(world(SCENE)), 0)
    record(cell, "parquet", tmp_path)
    tables = {"parquet": pd.read_parquet(tmp_path / "signals.parquet")}
    again = SimulatedCell(WorldModel(world(SCENE)), 0)
    record(again, "csv", tmp_path)
    tables["csv"] = pd.read_csv(tmp_path / "signals.csv")
    assert list(tables["csv"].columns) == list(tables["parquet"].columns)
    np.testing.assert_allclose(tables["csv"], tables["parquet"], rtol=1e-8, atol=1e-12)
    last, arm, truth = tables["parquet"].iloc[-1], cell.cell.arm(ARM[SCENE]), cell.ground_truth
    name, hand = ARM[SCENE].partition("#")[2], GRIPPER[SCENE].partition("#")[2]
    assert last["time_s"] == cell.clock.now and len(tables["csv"]) == TICKS
    for number, angle in enumerate(arm.measured.q, 1):
        assert last[f"{name}/sensor/joint_{number}_rad"] == angle
    pose = arm.measured.pose
    assert last[f"{name}/estimate/tool_z_m"] == pose.position[2]
    assert last[f"{name}/estimate/tool_qy"] == quaternion_from_rotation(pose.rotation)[2]
    assert last[f"{name}/command/stiffness_x_n_m"] == arm.compliance.commanded_stiffness[0]
    assert last[f"{hand}/truth/opening_m"] == truth.hand(GRIPPER[SCENE]).opening_m


def test_the_dictionary_and_the_metadata_say_what_the_columns_are(tmp_path: Path) -> None:
    record(KinematicCell(WorldModel(world(SCENE))), "parquet", tmp_path)
    dictionary = json.loads((tmp_path / "signals.json").read_text())
    schema = pq.read_schema(tmp_path / "signals.parquet")
    assert [each["column"] for each in dictionary["signals"]] == schema.names and len(schema.names) > 40
    assert dictionary["period_s"] == 0.01 and len(set(schema.names)) == len(schema.names)
    for each in dictionary["signals"][1:]:
        known = {key.decode(): value.decode() for key, value in schema.field(each["column"]).metadata.items()}
        assert known.items() >= {name: each[name] for name in ("device", "origin", "unit", "frame")}.items()
        assert each["column"].split("/")[1] == each["origin"] in ("truth", "sensor", "estimate", "command")
    units = {each["unit"] for each in dictionary["signals"]}
    assert units == {"", "s", "m", "rad", "m/s", "rad/s", "N", "N m", "N/m", "N m/rad"}


class Full:
    """A sink without room."""

    def __init__(self, signals: Sequence[Signal]) -> None:
        self.rows = 0

    def write(self, row: Array) -> None:
        self.rows += 1
        raise OSError(28, "No space left on device")

    def close(self) -> None:
        pass


def test_a_full_disk_ends_the_signals_and_not_the_run() -> None:
    cell = KinematicCell(WorldModel(world(SCENE)))
    sinks: list[Full] = []

    def make(signals: Sequence[Signal]) -> Full:
        sinks.append(Full(signals))
        return sinks[0]

    sampler = SignalSampler(cell, make)
    for _ in range(2):
        cell.advance(0.01)
        sampler.sample()
    assert sampler.problem == "No space left on device" and sinks[0].rows == 1


def test_without_a_folder_or_a_package_there_is_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    run = CliRunner().invoke(skillc, ["run", "clean_table", "--signals", "csv"])
    assert run.exit_code == 2 and "--signals records to a folder, which --out names" in run.stderr
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(RequestError, match=r"--signals parquet needs .*pyarrow.*: pip install 'skillc\[data\]'"):
        check_signals("parquet", Path("out"))
