"""Start a task in a cell of a server.

The operation goes on whatever becomes of this command.

Exit code 3 if the task does not succeed, with --wait or --attach.
"""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING, Any

import click
from msgspec import structs

from skillc.cli.command import Command
from skillc.cli.options import EXECUTION, SHARE, grouped_option
from skillc.cli.order_options import order_options
from skillc.cli.output.operation_remarks import remark_going_on, remark_status, remark_waiting
from skillc.cli.server_access import request_options
from skillc.cli.server_completions import complete_breakpoint
from skillc.cli.server_connection import connect_server, server_options
from skillc.cli.struct_options import struct_options
from skillc_runtime.recording.run_spec import RunRequest

if TYPE_CHECKING:
    from skillc.client.operation import ServerOperation

TIMES = {"every": "every_s", "until": "until", "count": "count", "missed": "missed"}
"""The keywords of an order, by its options."""
ATTENDED = ("step", "breakpoints", "confirm_steps")
"""The fields of a request for which somebody has to attend to the operation: what is started at a time has none."""
EXAMPLES = """
skillc start clean_table --cell iiwa_table
skillc start deliver tray=lab:Tray-1 --wait
skillc start --goal "lab:Box-A contain lab:Part-A" --approve
skillc start clean_table --at 2027-01-04T07:00:00+01:00 --every 86400 --missed skip
"""


@click.command(cls=Command, examples=EXAMPLES)
@request_options
@click.option("--wait", is_flag=True, help="Wait for the end.")
@click.option("--attach", is_flag=True, help="Show the task while it runs, as `skillc attach` does.")
@struct_options(RunRequest, types={"speed": SHARE}, complete={"breakpoints": complete_breakpoint})
@grouped_option(EXECUTION, "--key", metavar="TEXT", help="The same request with the same key is one operation.")
@order_options
@server_options
def command(
    request: RunRequest,
    cell: str | None,
    wait: bool,
    attach: bool,
    key: str | None,
    at: datetime | None,
    **repeated: Any,
) -> int:
    """Start TASK of the cell's library, and print the id of the operation, or with --at that of the order."""
    if wait and attach:
        raise click.UsageError("--wait and --attach cannot be combined")
    if at is None and any(value is not None for value in repeated.values()):
        raise click.UsageError("--every, --until, --count and --missed need --at")
    if at is not None and (wait or attach or any(getattr(request, each) for each in ATTENDED)):
        raise click.UsageError("--at cannot be combined with --wait, --attach, --step, --breakpoints, --confirm-steps")
    with connect_server() as server:
        place = server.cell(cell)
        wanted = structs.asdict(request)
        if at is not None:
            times = {TIMES[name]: value for name, value in repeated.items() if value is not None}
            ordered = {name: value for name, value in wanted.items() if name not in ATTENDED}
            click.echo(place.order(**ordered, **times, at=at, key=key).id)
            return 0
        remark_waiting(place.status)
        started = place.start(**wanted, key=key)
        click.echo(started.id)
        if attach:
            from skillc.cli.progress.attached import attach as show

            return show(place, started)
        return wait_for_end(started) if wait else 0


def wait_for_end(operation: ServerOperation) -> int:
    """Wait for the end of an operation, print how it ended, and return the exit code.

    Who interrupts that is reminded that the operation goes on.
    """
    try:
        status = operation.wait()  # wait ends: with the operation, by an interrupt, or when the server is away too long
    except KeyboardInterrupt:
        remark_going_on(operation.id)
        raise
    remark_status(status)
    return 0 if status.is_sound else 3
