"""Reset a simulated cell to its scene, save it under a name, or restore it."""

from __future__ import annotations

import sys
from datetime import UTC, datetime

import click

from skillc.cli.command import Command, Group
from skillc.cli.console import page_of, print_json, print_lines, print_remark
from skillc.cli.options import json_option
from skillc.cli.server_completions import complete_cell, complete_checkpoint
from skillc.cli.server_connection import connect_server, server_options

CELL = click.option(
    "--cell", metavar="NAME", shell_complete=complete_cell, help="The cell, unless the server has only one."
)
CHECKPOINT = click.argument("checkpoint", shell_complete=complete_checkpoint)
WHY = click.option("--why", default="", metavar="TEXT", help="The reason, for the history of its world.")


@click.group(cls=Group)
def command() -> None:
    """Reset a simulated cell of a server to its scene, save it under a name, or restore it.

    What is known of the world and what is really so change together. This is refused while operations go on or wait,
    and for cells that are no simulation. The history of the world says who did it.
    """


@command.command(cls=Command, examples="skillc cell reset --why 'the next demonstration'")
@CELL
@WHY
@server_options
def reset(cell: str | None, why: str) -> None:
    """Make a cell again as its scene says."""
    with connect_server() as server:
        status = server.cell(cell).reset(why)
    print_remark(f"{status.name}: reset to {status.scene}")


@command.command(cls=Command, examples="skillc cell save sorted")
@click.argument("checkpoint")
@CELL
@server_options
def save(checkpoint: str, cell: str | None) -> None:
    """Save a cell as it is, under the name CHECKPOINT, which no other one has."""
    with connect_server() as server:
        place = server.cell(cell)
        saved = place.save(checkpoint)
        print_remark(f"{place.name}: saved as {saved.name}")


@command.command(cls=Command, examples="skillc cell restore sorted")
@CHECKPOINT
@CELL
@WHY
@server_options
def restore(checkpoint: str, cell: str | None, why: str) -> None:
    """Make a cell again as it was saved as CHECKPOINT, with the same scene and library."""
    with connect_server() as server:
        status = server.cell(cell).restore(checkpoint, why)
    print_remark(f"{status.name}: restored as it was saved as {checkpoint}")


@command.command("list", cls=Command)
@CELL
@json_option
@server_options
def list_checkpoints(cell: str | None, as_json: bool) -> None:
    """List the checkpoints of a cell: name, when and by whom it was saved, and with which scene."""
    with connect_server() as server:
        found = server.cell(cell).checkpoints()
    if as_json:
        print_json(found)
    else:
        times = [f"{datetime.fromtimestamp(each.saved_ns / 1e9, UTC):%Y-%m-%d %H:%M:%SZ}" for each in found]
        rows = [(each.name, saved, each.who, each.scene) for each, saved in zip(found, times, strict=True)]
        print_lines(page_of(sys.stdout).columns(rows))


@command.command(cls=Command)
@CHECKPOINT
@CELL
@server_options
def remove(checkpoint: str, cell: str | None) -> None:
    """Forget CHECKPOINT."""
    with connect_server() as server:
        server.cell(cell).remove_checkpoint(checkpoint)
    print_remark(f"{checkpoint}: removed")
