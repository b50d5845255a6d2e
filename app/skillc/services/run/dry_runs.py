"""Dry runs: a task is simulated from where real devices are, and the commands that they would get are kept."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path

from skillc.errors import ServiceError
from skillc.services.project.backends import BackendName
from skillc.services.run.connecting import connected_devices
from skillc.services.run.unstarted_runs import CannotBegin
from skillc_runtime.backends.control_process.dry_cell import DryCell
from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.command_record import UNITS, CommandRecord, RecordedCommands
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel

COMMANDS = "commands.csv"
"""The file with what would be sent, in the folder of a run."""


def make_dry_cell(backend: BackendName, seed: int, world: WorldModel) -> Backend:
    """Look where the devices of a back end are, and return a simulation that begins there.

    CannotBegin if a device is not ready, or contradicts the scene; RequestError and ServiceError as of
    `connected_devices`.
    """
    with connected_devices(world.snapshot(), backend) as observer:
        seen = observer.observe()
    if seen.problems:
        raise CannotBegin("; ".join(seen.problems))
    try:
        return DryCell(world, seed, seen)
    except SheetError as error:
        raise CannotBegin(str(error)) from error


def write_commands(record: CommandRecord, folder: Path) -> None:
    """Write what would be sent, one row a cycle and arm; ServiceError if the folder cannot be written to.

    Each joint has a column, which is empty in the rows of arms that have no joint of its name.
    """
    sent = tuple(record.commands())
    joints = dict.fromkeys(joint for each in sent for joint in each.joints)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with (folder / COMMANDS).open("w", encoding="utf-8", newline="") as file:
            table = csv.DictWriter(file, ("arm", "kind", "unit", "time_s", *joints))
            table.writeheader()
            table.writerows(row for each in sent for row in _list_rows(each))
    except OSError as error:
        raise ServiceError(f"{folder / COMMANDS} cannot be written: {error.strerror}") from error


def _list_rows(sent: RecordedCommands) -> Iterator[dict[str, str]]:
    """Yield a row for each command of an arm."""
    about = {"arm": sent.arm, "kind": sent.mode, "unit": UNITS[sent.mode]}
    for time_s, values in zip(sent.times_s, sent.values, strict=True):
        joints = zip(sent.joints, (f"{each:.6f}" for each in values), strict=True)
        yield {**about, "time_s": f"{time_s:.4f}", **dict(joints)}
