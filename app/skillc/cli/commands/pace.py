"""Set how fast the time of a cell passes."""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.console import print_remark
from skillc.cli.server_completions import complete_cell
from skillc.cli.server_connection import connect_server, server_options

EXAMPLES = """
skillc pace real
skillc pace 4 iiwa_table
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("pace", metavar="fast|real|N")
@click.argument("cell", required=False, shell_complete=complete_cell)
@server_options
def command(pace: str, cell: str | None) -> None:
    """Let the time of CELL pass as fast as it computes, or at most N times as fast as real time.

    What happens does not depend on it. CELL may be left out if it is the only one.
    """
    with connect_server() as server:
        status = server.cell(cell).set_pace(pace)
    print_remark(f"{status.name}: pace {pace}")
