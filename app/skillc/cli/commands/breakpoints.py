"""Show or change the breakpoints of an operation of a server."""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.output.operation_remarks import remark_status
from skillc.cli.server_access import operation_argument
from skillc.cli.server_completions import complete_breakpoint
from skillc.cli.server_connection import connect_server, server_options

EXAMPLES = """
skillc breakpoints
skillc breakpoints --breakpoints Pick --breakpoints sort.skill:12
skillc breakpoints --clear
"""


@click.command(cls=Command, examples=EXAMPLES)
@operation_argument
@click.option(
    "--breakpoints",
    "places",
    multiple=True,
    metavar="SKILL|FILE:LINE",
    shell_complete=complete_breakpoint,
    help="Pause before each call of a skill, or before the calls in a line, and at no others. Can be repeated.",
)
@click.option("--clear", is_flag=True, help="Pause at no call any more.")
@server_options
def command(operation: str | None, places: tuple[str, ...], clear: bool) -> None:
    """Print the breakpoints of OPERATION, one a line, or replace them.

    An operation that is paused stays paused; `skillc resume` continues it to the next breakpoint.
    """
    if places and clear:
        raise click.UsageError("--clear cannot be used with --breakpoints")
    with connect_server() as server:
        found = server.operation(operation)
        if places or clear:
            found.set_breakpoints(*places)
            remark_status(found.status)
        for each in found.breakpoints:
            click.echo(each)
