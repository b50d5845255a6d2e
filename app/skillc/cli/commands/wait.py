"""Wait until an operation pauses or ends.

Exit code 3 if it has ended without success.
"""

from __future__ import annotations

import click

from skillc.cli.command import Command
from skillc.cli.output.operation_remarks import remark_status
from skillc.cli.server_access import operation_argument
from skillc.cli.server_connection import connect_server, server_options


@click.command(cls=Command)
@operation_argument
@server_options
def command(operation: str | None) -> int:
    """Wait until OPERATION is paused, waits for approval, or has ended, and print how it is then."""
    from skillc_runtime.recording.states import ENDS

    with connect_server() as server:
        found = server.operation(operation)
        found.wait_for_pause()
        status = found.status
    remark_status(status)
    return 3 if status.state in ENDS and not status.is_sound else 0
