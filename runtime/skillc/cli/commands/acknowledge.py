"""Let a cell take operations again after a fault."""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.console import print_remark
from skillc.cli.server_access import complete_cell, connect_server, server_options


@click.command(cls=Command)
@click.argument("cell", required=False, shell_complete=complete_cell)
@server_options
def command(cell: str | None) -> None:
    """Let CELL take operations again after a fault whose cause is removed; it may be left out if it is the only one."""
    with connect_server() as server:
        status = server.cell(cell).acknowledge()
    print_remark(f"{status.name}: {status.state}")
