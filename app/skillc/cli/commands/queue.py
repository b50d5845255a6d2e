"""List the operations that wait in a cell of a server, or change their order."""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.options import json_option
from skillc.cli.server_access import cell_option
from skillc.cli.server_completions import complete_operation
from skillc.cli.server_connection import connect_server, server_options

EXAMPLES = """
skillc queue
skillc queue carry-20270104T070000Z-a1b2c3
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("operations", nargs=-1, metavar="[OPERATION..]", shell_complete=complete_operation)
@cell_option
@json_option
@server_options
def command(operations: tuple[str, ...], cell: str | None, as_json: bool) -> None:
    """List the operations that wait in a cell, in the order in which they get planners and devices.

    OPERATIONs are put before all others that wait, in this order and whatever their priority. Operations that run keep
    their devices.
    """
    from skillc.cli.console import print_json
    from skillc.cli.output.server import print_operations

    with connect_server() as server:
        place = server.cell(cell)
        queue = place.reorder(operations) if operations else place.queue()
    if as_json:
        print_json(queue)
    else:
        print_operations(queue)
