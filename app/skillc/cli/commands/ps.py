"""List the cells of a server and their operations."""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.options import json_option
from skillc.cli.server_connection import connect_server, server_options

LAST = 20


@click.command(cls=Command)
@click.option(
    "--all", "everything", is_flag=True, help=f"List also the last {LAST} operations that ended, of each cell."
)
@click.option("--watch", is_flag=True, help="Show what changes, until Ctrl-C; with --json as a line for each change.")
@json_option
@server_options
def command(everything: bool, watch: bool, as_json: bool) -> None:
    """List the cells, and the operations that go on or wait: id, task, state, who submitted it."""
    from skillc.cli.console import print_json
    from skillc.cli.output.server import print_cells, watch_cells

    with connect_server() as server:
        if watch:
            watch_cells(server.watch(), as_json)
            return
        cells = server.cells()
        found = [each for cell in cells for each in server.cell(cell.name).operations(LAST, ongoing=not everything)]
        operations = [each.last_status for each in found]
        if as_json:
            print_json({"cells": cells, "operations": operations})
        else:
            print_cells(cells, operations)
