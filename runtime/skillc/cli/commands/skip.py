"""Count the failed step of an operation as done."""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.server_access import connect_server, operation_argument, remark_status, server_options


@click.command(cls=Command, examples='skillc skip --why "the part was put in by hand"')
@operation_argument
@click.option("--why", required=True, help="Why it is done; the history says so, with the name of the token.")
@server_options
def command(operation: str | None, why: str) -> None:
    """Count the failed step of OPERATION, which waits for a decision, as done: its effects are assumed."""
    with connect_server() as server:
        found = server.operation(operation)
        found.skip(why)
        remark_status(found.status)
