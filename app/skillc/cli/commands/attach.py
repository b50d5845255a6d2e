"""Show an operation of a server in the terminal while it runs.

Exit code 3 if it does not succeed, 0 if it does or goes on.
"""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.server_access import operation_argument
from skillc.cli.server_connection import connect_server, server_options


@click.command(cls=Command)
@operation_argument
@server_options
def command(operation: str | None) -> int:
    """Show OPERATION as `skillc run` shows a task, with its keys.

    `d` or Ctrl-C detaches, which changes nothing in the cell; `q` stops the operation.
    """
    from skillc.cli.progress.attached import attach

    with connect_server() as server:
        found = server.operation(operation)
        return attach(server.cell(found.last_status.cell), found)
