"""Let a cell take operations again after a fault or a stop."""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.console import print_remark
from skillc.cli.server_completions import complete_cell
from skillc.cli.server_connection import connect_server, server_options


@click.command(cls=Command)
@click.argument("cell", required=False, shell_complete=complete_cell)
@server_options
def command(cell: str | None) -> None:
    """Let CELL take operations again after a fault or a stop whose cause is removed.

    The name may be left out if there is only one cell.
    """
    with connect_server() as server:
        status = server.cell(cell).acknowledge()
    print_remark(f"{status.name}: {status.state}")
