"""Reset a simulated cell to its scene, save it under a name, or restore it."""

from __future__ import annotations

import sys
from datetime import UTC, datetime

import click

from skillc.cli.command import Command, Group
from skillc.cli.console import page_of, print_json, print_lines, print_remark
from skillc.cli.options import json_option
from skillc.cli.server_access import cell_option
from skillc.cli.server_completions import complete_checkpoint
from skillc.cli.server_connection import connect_server, server_options

CHECKPOINT = click.argument("checkpoint", shell_complete=complete_checkpoint)
WHY = click.option("--why", default="", metavar="TEXT", help="The reason, for the history of its world.")


@click.group(cls=Group)
def command() -> None:
    """Reset a simulated cell of a server to its scene, save it under a name, or restore it.

    The world model and the simulation change together. The history of the world says who did it. All commands but
    `list` are refused while operations go on or wait; cells that are no simulation cannot be reset, saved or restored.
    """


@command.command(cls=Command, examples="skillc cell reset --why 'the next demonstration'")
@cell_option
@WHY
@server_options
def reset(cell: str | None, why: str) -> None:
    """Reset a cell to its scene."""
    with connect_server() as server:
        status = server.cell(cell).reset(why)
    print_remark(f"{status.name}: reset to {status.scene}")


@command.command(cls=Command, examples="skillc cell save sorted")
@click.argument("checkpoint")
@cell_option
@server_options
def save(checkpoint: str, cell: str | None) -> None:
    """Save a cell as CHECKPOINT, a name that no other checkpoint has."""
    with connect_server() as server:
        place = server.cell(cell)
        saved = place.save(checkpoint)
        print_remark(f"{place.name}: saved as {saved.name}")


@command.command(cls=Command, examples="skillc cell restore sorted")
@CHECKPOINT
@cell_option
@WHY
@server_options
def restore(checkpoint: str, cell: str | None, why: str) -> None:
    """Restore a cell from CHECKPOINT. The scene and the library must be the same as then."""
    with connect_server() as server:
        status = server.cell(cell).restore(checkpoint, why)
    print_remark(f"{status.name}: restored from {checkpoint}")


@command.command("list", cls=Command)
@cell_option
@json_option
@server_options
def list_checkpoints(cell: str | None, as_json: bool) -> None:
    """List the checkpoints of a cell.

    Prints the name of each, when and by whom it was saved, and the scene.
    """
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
@cell_option
@server_options
def remove(checkpoint: str, cell: str | None) -> None:
    """Remove CHECKPOINT."""
    with connect_server() as server:
        server.cell(cell).remove_checkpoint(checkpoint)
    print_remark(f"{checkpoint}: removed")
