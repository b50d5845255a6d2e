"""Take, show or give back the lease of a cell: its owner alone may command it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command, Group
from skillc.cli.console import print_remark
from skillc.cli.server_completions import complete_cell
from skillc.cli.server_connection import connect_server, server_options

if TYPE_CHECKING:
    from skillc.contract.cell import Lease

CELL = click.argument("cell", required=False, shell_complete=complete_cell)


@click.group(cls=Group)
def command() -> None:
    """Take, show or give back the lease of a cell.

    While a client has it, no other one may command the cell; everybody may watch and stop it.
    """


@command.command(cls=Command, examples="skillc lease take --for 600")
@CELL
@click.option(
    "--for",
    "duration",
    type=click.FloatRange(min=0.0, min_open=True),
    default=60.0,
    show_default=True,
    metavar="SECONDS",
    help="For how long; take it again to prolong it.",
)
@click.option("--takeover", is_flag=True, help="End the lease of another client; this needs the role `admin`.")
@server_options
def take(cell: str | None, duration: float, takeover: bool) -> None:
    """Be the only client that may command CELL."""
    with connect_server() as server:
        _remark(server.cell(cell).take_lease(duration, takeover))


@command.command(cls=Command)
@CELL
@server_options
def show(cell: str | None) -> None:
    """Print who has the lease of CELL."""
    with connect_server() as server:
        click.echo(_describe(server.cell(cell).lease))


@command.command(cls=Command)
@CELL
@server_options
def release(cell: str | None) -> None:
    """Let others command CELL again."""
    with connect_server() as server:
        place = server.cell(cell)
        place.release_lease()
        _remark(place.lease)


def _remark(lease: Lease) -> None:
    print_remark(_describe(lease))


def _describe(lease: Lease) -> str:
    if lease.owner is None:
        return f"{lease.cell}: nobody has the lease"
    return f"{lease.cell}: {lease.owner} has the lease for {lease.remaining_s:.0f} s"
