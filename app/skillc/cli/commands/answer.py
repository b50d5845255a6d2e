"""Answer what a skill of an operation asks."""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.output.operation_remarks import remark_status
from skillc.cli.server_access import operation_argument
from skillc.cli.server_completions import complete_answer
from skillc.cli.server_connection import connect_server, server_options

EXAMPLES = """
skillc answer yes
skillc answer "put it aside" sort_parts-20261124T120000Z-1f0c9a
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("choice", shell_complete=complete_answer)
@operation_argument
@click.option("--prompt", default=0, metavar="NUMBER", help="Which prompt, if the operation has several.")
@server_options
def command(choice: str, operation: str | None, prompt: int) -> None:
    """Answer with CHOICE, one of the choices that `skillc ps` lists, what a skill of OPERATION asks."""
    with connect_server() as server:
        found = server.operation(operation)
        found.answer(choice, prompt)
        remark_status(found.status)
