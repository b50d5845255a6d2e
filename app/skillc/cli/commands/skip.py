"""Count the failed step of an operation as done."""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.server_access import decide, decided_argument
from skillc.cli.server_connection import server_options


@click.command(cls=Command, examples='skillc skip --why "the part was put in by hand"')
@decided_argument("skip")
@click.option("--why", required=True, help="Why it is done; the history says so, with the name of the token.")
@server_options
def command(operation: str | None, why: str) -> None:
    """Count the failed step of OPERATION, which waits for a decision, as done: its effects are assumed.

    If OPERATION was interrupted, another one continues it after the step that was running; its id is printed.
    """
    decide(operation, "skip", lambda found: found.skip(why), why)
