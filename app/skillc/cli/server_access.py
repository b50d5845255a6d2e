"""What the commands share that are clients of a server: which cell, which operation, and what it is given."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.options import grouped_option, task_arguments
from skillc.cli.output.operation_remarks import remark_status
from skillc.cli.server_completions import (
    Complete,
    complete_any_operation,
    complete_argument,
    complete_cell,
    complete_operation,
    complete_served_task,
    complete_undecided,
)
from skillc.cli.server_connection import CELL, SERVER, Function, connect_server, keep_choice, server_options

if TYPE_CHECKING:
    from skillc.client.operation import ServerOperation
    from skillc_runtime.recording.states import Decision


cell_option = click.option(
    "--cell", metavar="NAME", shell_complete=complete_cell, help="The cell, unless the server has only one."
)


def request_options(function: Function) -> Function:
    """Add TASK with its arguments, and `--cell`, to a command that is a client."""
    options = (
        click.argument("task", required=False, shell_complete=complete_served_task),
        task_arguments(complete_argument),
        cell_option,
    )
    for option in reversed(options):
        function = option(function)
    return function


def cell_options(function: Function) -> Function:
    """Add `--cell` and the options of a server to a command that works without one, too; see `asked_cell`."""
    cell = grouped_option(
        SERVER,
        "--cell",
        metavar="NAME",
        help="Ask a cell of `skillc serve`, as its world is now; with --server alone, its only cell.",
        expose_value=False,
        shell_complete=complete_cell,
        callback=lambda context, _, value: keep_choice(context, CELL, value),
    )
    return cell(server_options(function))


def refuse_options(**given: object) -> None:
    """Raise UsageError if an option is given that is not for a cell of a server."""
    for name, value in given.items():
        if value:
            raise click.UsageError(f"--{name.replace('_', '-')} cannot be used with a cell of a server")


def operation_argument(function: Function) -> Function:
    """Add OPERATION, one that goes on; it may be left out if only one does."""
    return _make_operation_argument(complete_operation)(function)


def any_operation_argument(function: Function) -> Function:
    """Add OPERATION, also one that has ended; it may be left out if only one goes on."""
    return _make_operation_argument(complete_any_operation)(function)


def decided_argument(decision: Decision) -> Callable[[Function], Function]:
    """Return what adds OPERATION, one that a decision can continue; it may be left out if only one goes on."""
    return _make_operation_argument(complete_undecided(decision))


def _make_operation_argument(complete: Complete) -> Callable[[Function], Function]:
    return click.argument("operation", required=False, metavar="[OPERATION]", shell_complete=complete)


def make_operation_command(help: str, act: Callable[[ServerOperation], None], examples: str = "") -> click.Command:
    """Return a command that gives an operation a command, and prints how it is then."""

    @click.command(cls=Command, help=help, examples=examples)
    @operation_argument
    @server_options
    def command(operation: str | None) -> None:
        with connect_server() as server:
            found = server.operation(operation)
            act(found)
            remark_status(found.status)

    return command


def make_decision_command(help: str, decision: Decision, act: Callable[[ServerOperation], None]) -> click.Command:
    """Return a command that decides about an operation that failed or was interrupted, and prints how it is then."""

    @click.command(cls=Command, help=help)
    @decided_argument(decision)
    @server_options
    def command(operation: str | None) -> None:
        decide(operation, decision, act)

    return command


def decide(operation: str | None, decision: Decision, act: Callable[[ServerOperation], None], why: str = "") -> None:
    """Give an operation a command; one that was interrupted is continued by another one, whose id is printed."""
    with connect_server() as server:
        found = server.operation(operation)
        if found.last_status.state == "interrupted":
            found = found.continue_as(decision, why)
            click.echo(found.id)
        else:
            act(found)
        remark_status(found.status)
