"""Stop what goes on in the cells of a server, or one operation."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.console import print_remark
from skillc.cli.output.operation_remarks import remark_status
from skillc.cli.server_access import operation_argument
from skillc.cli.server_completions import complete_cell
from skillc.cli.server_connection import connect_server, server_options

if TYPE_CHECKING:
    from skillc.client.operation import ServerOperation
    from skillc.client.server import Server

EXAMPLES = """
skillc stop
skillc stop --cell cell
skillc stop carry-20270104T070000Z-a1b2c3
"""


@click.command(cls=Command, examples=EXAMPLES)
@operation_argument
@click.option("--all", "everything", is_flag=True, help="Stop all operations, as without OPERATION.")
@click.option("--cell", metavar="NAME", shell_complete=complete_cell, help="Stop those of this cell only.")
@click.option("--why", default="stopped", help="The reason, which everybody sees.")
@server_options
def command(operation: str | None, everything: bool, cell: str | None, why: str) -> None:
    """Halt all that goes on, or OPERATION, in the next tick, and wait until everything is at rest.

    Whoever started it, and whatever it waits for. This is no emergency stop.
    """
    if operation is not None and (everything or cell is not None):
        raise click.UsageError("give an operation, or --all or --cell")
    with connect_server() as server:
        if operation is None:
            found = stop_all(server, cell, why)
        else:
            found = [server.operation(operation)]
            found[0].stop(why)
        if not found:
            print_remark("nothing goes on")
        for each in found:
            # wait ends: when the cell is at rest, by an interrupt, or when the server is away too long
            remark_status(each.wait())


def stop_all(server: Server, name: str | None, why: str) -> list[ServerOperation]:
    """Stop all operations of a cell, or of all cells; return them."""
    cells = [server.cell(each) for each in ([each.name for each in server.cells()] if name is None else [name])]
    found = [operation for each in cells for operation in each.operations(ongoing=True)]
    for each in cells:
        each.stop(why)
    return found
