"""Start a task in a cell of a server.

The operation goes on whatever becomes of this command.

Exit code 3 if the task does not succeed, with --wait or --attach.
"""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING, Any

import click

from skillc.cli.command import Command
from skillc.cli.operation_remarks import remark_going_on, remark_status, remark_waiting
from skillc.cli.options import EXECUTION, grouped_option
from skillc.cli.order_options import order_options
from skillc.cli.server_access import request_options
from skillc.cli.server_completions import complete_pause_at
from skillc.cli.server_connection import connect_server, server_options

if TYPE_CHECKING:
    from skillc.client.cell import ServerCell
    from skillc.client.operation import ServerOperation
    from skillc.contract.order import Missed

EXAMPLES = """
skillc start clean_table --cell iiwa_table
skillc start deliver tray=lab:Tray-1 --wait
skillc start --goal "lab:Bin-A contain lab:Part-1" --approve
skillc start clean_table --at 2027-01-04T07:00:00+01:00 --every 86400 --missed skip
"""


@click.command(cls=Command, examples=EXAMPLES)
@request_options
@click.option("--wait", is_flag=True, help="Wait for the end.")
@click.option("--attach", is_flag=True, help="Show the task while it runs, as `skillc attach` does.")
@grouped_option(EXECUTION, "--approve", is_flag=True, help="Let each plan wait for `skillc approve`.")
@grouped_option(EXECUTION, "--ask", is_flag=True, help="Let a failed step wait for `skillc retry`, `skip` or `replan`.")
@grouped_option(EXECUTION, "--step", is_flag=True, help="Pause before the first call.")
@grouped_option(
    EXECUTION,
    "--pause-at",
    multiple=True,
    metavar="SKILL|FILE:LINE",
    shell_complete=complete_pause_at,
    help="Pause before each call of a skill, or before the calls in a line. Can be repeated.",
)
@grouped_option(
    EXECUTION,
    "--deadline",
    type=click.FloatRange(min=0.0, min_open=True),
    metavar="SECONDS",
    help="Let the task fail if it has not ended after these seconds of the cell's time.",
)
@grouped_option(
    EXECUTION,
    "--step-deadline",
    type=click.FloatRange(min=0.0, min_open=True),
    metavar="SECONDS",
    help="Let a primitive or a wait fail if it has not ended after these seconds of the cell's time.",
)
@grouped_option(EXECUTION, "--priority", default=0, help="Of operations that wait, the higher comes first.")
@grouped_option(EXECUTION, "--key", metavar="TEXT", help="The same request with the same key is one operation.")
@order_options
@server_options
def command(
    task: str | None,
    arguments: dict[str, str],
    cell: str | None,
    goal: str | None,
    skill: str | None,
    wait: bool,
    attach: bool,
    approve: bool,
    ask: bool,
    step: bool,
    pause_at: tuple[str, ...],
    deadline: float | None,
    step_deadline: float | None,
    priority: int,
    key: str | None,
    at: datetime | None,
    **repeated: Any,
) -> int:
    """Start TASK of the cell's library, and print the id of the operation, or with --at that of the order."""
    if wait and attach:
        raise click.UsageError("--wait and --attach cannot be combined")
    if at is None and any(value is not None for value in repeated.values()):
        raise click.UsageError("--every, --until, --count and --missed need --at")
    if at is not None and (wait or attach or step or pause_at):
        raise click.UsageError("--at cannot be combined with --wait, --attach, --step and --pause-at")
    with connect_server() as server:
        place = server.cell(cell)
        request: dict[str, Any] = {
            "arguments": arguments,
            "goal": goal,
            "skill": skill,
            "approve": approve,
            "ask_after_failure": ask,
            "priority": priority,
            "deadline_s": deadline,
            "step_deadline_s": step_deadline,
            "key": key,
        }
        if at is not None:
            return _order(place, task, at, request, **repeated)
        remark_waiting(place.status)
        started = place.start(task, step=step, pause_at=pause_at, **request)
        click.echo(started.id)
        if attach:
            from skillc.cli.attached import attach as show

            return show(place, started)
        return wait_for_end(started) if wait else 0


def _order(
    place: ServerCell,
    task: str | None,
    at: datetime,
    request: dict[str, Any],
    every: float | None,
    until: datetime | None,
    count: int | None,
    missed: Missed | None,
) -> int:
    order = place.order(task, at=at, every_s=every, until=until, count=count, missed=missed or "run-once", **request)
    click.echo(order.id)
    return 0


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
