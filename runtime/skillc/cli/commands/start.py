"""Start a task in a cell of a server.

The operation goes on whatever becomes of this command.

Exit code 3 if the task does not succeed, with --wait or --attach.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.completions import complete_task
from skillc.cli.options import EXECUTION, grouped_option, task_arguments
from skillc.cli.server_access import complete_cell, connect_server, remark_going_on, remark_status, server_options

if TYPE_CHECKING:
    from skillc.client.operation import ServerOperation

EXAMPLES = """
skillc start clean_table --cell iiwa_table
skillc start deliver tray=lab:Tray-1 --wait
skillc start --goal "lab:Bin-A contain lab:Part-1" --approve
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("task", required=False, shell_complete=complete_task)
@task_arguments
@click.option("--cell", metavar="NAME", shell_complete=complete_cell, help="The cell, unless the server has only one.")
@click.option("--goal", metavar="CONDITION", help="Instead of a task: plan for this goal, a condition or PDDL.")
@click.option("--skill", metavar="CALL", help="Instead of a task: call a skill, as in `Wipe(surface: lab:Table-1)`.")
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
    help="Pause before each call of a skill, or before the calls in a line. Can be repeated.",
)
@grouped_option(
    EXECUTION,
    "--deadline",
    type=click.FloatRange(min=0.0, min_open=True),
    metavar="SECONDS",
    help="Let the task fail if it has not ended after these seconds of the cell's time.",
)
@grouped_option(EXECUTION, "--priority", default=0, help="Of operations that wait, the higher comes first.")
@grouped_option(EXECUTION, "--key", metavar="TEXT", help="The same request with the same key is one operation.")
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
    priority: int,
    key: str | None,
) -> int:
    """Start TASK of the cell's library, and print the id of the operation."""
    if wait and attach:
        raise click.UsageError("--wait and --attach cannot be combined")
    with connect_server() as server:
        place = server.cell(cell)
        started = place.start(
            task,
            arguments=arguments,
            goal=goal,
            skill=skill,
            approve=approve,
            ask_after_failure=ask,
            priority=priority,
            deadline_s=deadline,
            step=step,
            pause_at=pause_at,
            key=key,
        )
        click.echo(started.id)
        if attach:
            from skillc.cli.attached import attach as show

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
    return 0 if status.state == "succeeded" else 3
