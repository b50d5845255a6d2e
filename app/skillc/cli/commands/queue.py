"""List the operations that wait in a cell of a server, or change their order."""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.options import json_option
from skillc.cli.server_completions import complete_cell, complete_operation
from skillc.cli.server_connection import connect_server, server_options

EXAMPLES = """
skillc queue
skillc queue carry-20270104T070000Z-a1b2c3
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("operations", nargs=-1, metavar="[OPERATION..]", shell_complete=complete_operation)
@click.option("--cell", metavar="NAME", shell_complete=complete_cell, help="The cell, unless the server has only one.")
@json_option
@server_options
def command(operations: tuple[str, ...], cell: str | None, as_json: bool) -> None:
    """List the operations that wait in a cell, in the order in which they get planners and devices.

    OPERATIONs come first from then on, in this order, before all others that wait and whatever their priority. What
    runs gives nothing back.
    """
    from skillc.cli.console import print_json
    from skillc.cli.server_output import print_operations

    with connect_server() as server:
        place = server.cell(cell)
        queue = place.reorder(operations) if operations else place.queue()
    if as_json:
        print_json(queue)
    else:
        print_operations(queue)
