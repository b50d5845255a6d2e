"""Back up, restore, repair or prune the state of a server, or print its audit log."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import click

from skillc.cli.command import Command, Group
from skillc.cli.console import print_remark
from skillc.cli.options import FOLDER

STATE = click.option(
    "--state", type=FOLDER, default=Path(".skillc"), show_default=True, help="The state folder of the server."
)
DAY_NS = 86_400 * 10**9
UNITS = {"kB": 10**3, "MB": 10**6, "GB": 10**9}


class Size(click.ParamType[int]):
    """A number of bytes, such as `500MB`."""

    name = "size"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Return the number of bytes; fail for anything else."""
        number, factor = next(((value[:-2], UNITS[unit]) for unit in UNITS if str(value).endswith(unit)), (value, 1))
        try:
            return int(float(number) * factor)
        except (ValueError, OverflowError):
            self.fail(f"{value!r} is no size; write 500MB or 2GB", param, ctx)


@click.group(cls=Group)
def command() -> None:
    """Back up, restore, repair or prune what `skillc serve` keeps in its state folder, or print its audit log."""


@command.command(cls=Command)
@click.argument("backup", type=FOLDER)
@STATE
def backup(backup: Path, state: Path) -> None:
    """Copy the state to the new folder BACKUP, also while a server uses it."""
    from skillc.server.backup import back_up

    back_up(state, backup)
    print_remark(f"{state} is copied to {backup}; it is a state folder itself, with the tokens of the server")


@command.command(cls=Command)
@click.argument("backup", type=FOLDER)
@STATE
def restore(backup: Path, state: Path) -> None:
    """Put a copy of the folder BACKUP in the place of the state, which no server may use.

    The former state is kept beside it.
    """
    from skillc.server.backup import restore as restore_state

    former = restore_state(backup, state)
    kept = f"; the former one is {former}" if former is not None else ""
    print_remark(f"{state} is as it was when {backup} was made{kept}")


@command.command(cls=Command)
@click.argument("cell")
@click.option("--why", required=True, metavar="TEXT", help="Why the facts in the store are right; the history says so.")
@STATE
def adopt(cell: str, why: str, state: Path) -> None:
    """Let CELL, which does not start because others wrote to its store, go on with the facts that are there.

    They count as given by a person then. Also while a server uses the state: it starts the cell within a minute.
    """
    from getpass import getuser

    from skillc.server.adopting import adopt as adopt_facts

    adopt_facts(state, cell, getuser(), why)
    print_remark(f"{cell} goes on with the facts in its store")


@command.command(cls=Command)
@STATE
@click.option("--older-than", "days", type=click.FloatRange(min=0.0), metavar="DAYS", help="Forget older operations.")
@click.option("--larger-than", "size", type=Size(), help="Forget the oldest operations until a cell uses this size.")
@click.option(
    "--audit-older-than",
    "audit_days",
    type=click.FloatRange(min=0.0),
    metavar="DAYS",
    help="Remove older entries of the audit log.",
)
def prune(state: Path, days: float | None, size: int | None, audit_days: float | None) -> None:
    """Forget operations that have ended, with their events, also while a server uses the state.

    The worlds of the cells stay, and without --audit-older-than the audit log, too.
    """
    if days is None and size is None and audit_days is None:
        raise click.UsageError("give --older-than DAYS, --larger-than SIZE or --audit-older-than DAYS")
    from skillc.server.pruning import prune as prune_state
    from skillc.server.pruning import prune_audit

    if days is not None or size is not None:
        before_ns = None if days is None else _days_ago_ns(days)
        for cell, count in prune_state(state, before_ns, size).items():
            print_remark(f"{cell}: {count} operations are forgotten")
    if audit_days is not None:
        print_remark(f"{prune_audit(state, _days_ago_ns(audit_days))} entries of the audit log are removed")


@command.command(cls=Command)
@STATE
def audit(state: Path) -> None:
    """Print the audit log, one JSON object a line, also while a server uses the state."""
    import msgspec

    from skillc.server.pruning import export_audit

    for each in export_audit(state):
        click.echo(msgspec.json.encode(each))


def _days_ago_ns(days: float) -> int:
    return time.time_ns() - int(days * DAY_NS)
