"""The table of what a dry run would have sent."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from skillc.services.run.dry_runs import write_commands
from skillc_runtime.devices.arm import ArmLimits, Mode
from skillc_runtime.devices.command_record import RecordedCommands

ONES = np.ones(2)
LIMITS = ArmLimits(np.array([[-1.0, 1.0], [-1.0, 1.0]]), ONES, ONES, ONES)


class Record:
    def commands(self) -> tuple[RecordedCommands, ...]:
        return (sent("lab:A", "position", ("pan", "lift")), sent("lab:B", "torque", ("pan", "elbow")))


def sent(arm: str, mode: Mode, joints: tuple[str, ...]) -> RecordedCommands:
    return RecordedCommands(arm, mode, joints, LIMITS, np.array([0.0, 0.5]), np.array([[0.1, 0.2], [0.3, 0.4]]), 0)


def test_the_commands_of_several_arms_are_one_table(tmp_path: Path) -> None:
    write_commands(Record(), tmp_path / "dry")
    with (tmp_path / "dry" / "commands.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [(row["arm"], row["kind"], row["time_s"]) for row in rows] == [
        ("lab:A", "position", "0.0000"),
        ("lab:A", "position", "0.5000"),
        ("lab:B", "torque", "0.0000"),
        ("lab:B", "torque", "0.5000"),
    ]
    assert (rows[1]["pan"], rows[1]["lift"], rows[1]["elbow"]) == ("0.300000", "0.400000", "")
    assert (rows[3]["pan"], rows[3]["lift"], rows[3]["elbow"]) == ("0.300000", "", "0.400000")
