"""Continue a paused operation until the next call of a skill."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.output.operation_remarks import remark_status
from skillc.cli.server_access import operation_argument
from skillc.cli.server_connection import connect_server, server_options

if TYPE_CHECKING:
    from skillc.client.async_operation import Depth

EXAMPLES = """
skillc step
skillc step over
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("depth", type=click.Choice(("into", "over", "out")), default="into")
@operation_argument
@server_options
def command(depth: Depth, operation: str | None) -> None:
    """Continue OPERATION until the next call of a skill starts, and pause it there.

    `over` skips the calls inside the present one, `out` those inside the call around it.
    """
    with connect_server() as server:
        found = server.operation(operation)
        found.step(depth)
        remark_status(found.status)
