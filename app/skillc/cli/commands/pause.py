"""Pause an operation of a server."""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.output.operation_remarks import remark_status
from skillc.cli.server_access import operation_argument
from skillc.cli.server_connection import connect_server, server_options


@click.command(cls=Command)
@operation_argument
@click.option("--why", default="requested", help="The reason, which everybody sees.")
@server_options
def command(operation: str | None, why: str) -> None:
    """Pause OPERATION at the next point where its skills may be paused, and wait until it is.

    A tool that presses goes on pressing for a while, and is then taken off; `skillc resume` continues.
    """
    with connect_server() as server:
        found = server.operation(operation)
        found.pause(why)
        remark_status(found.status)
