"""What the commands share that are clients of a server: which server, which operation or cell, what a shell offers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click
from click.shell_completion import CompletionItem

from skillc.cli.command import Command
from skillc.cli.completions import complete_task
from skillc.cli.options import PATH, grouped_option, task_arguments
from skillc.services.errors import ServiceError

if TYPE_CHECKING:
    from skillc.cells.operation import OperationStatus
    from skillc.client.cell import ServerCell
    from skillc.client.operation import ServerOperation
    from skillc.client.server import Server
    from skillc_runtime.recording.states import Decision

SERVER = "Server"
_URL, _TOKEN_FILE, _CELL = "skillc.cli.server", "skillc.cli.token_file", "skillc.cli.cell"
Function = TypeVar("Function", bound=Callable[..., Any])
Item = TypeVar("Item")


def server_options(function: Function) -> Function:
    """Add `--server` and `--token-file`, which `connect_server` reads."""
    url = grouped_option(
        SERVER,
        "--server",
        metavar="URL",
        help="The server; by default that of SKILLC_SERVER, or http://127.0.0.1:8421.",
        expose_value=False,
        callback=lambda context, _, value: _keep(context, _URL, value),
    )
    file = grouped_option(
        SERVER,
        "--token-file",
        type=PATH,
        help="The file with the token; by default that of SKILLC_TOKEN, or of the server in `.skillc`.",
        expose_value=False,
        callback=lambda context, _, value: _keep(context, _TOKEN_FILE, value),
    )
    return url(file(function))


def request_options(function: Function) -> Function:
    """Add TASK with its arguments, `--goal` and `--skill` in its place, and `--cell`, to a command that is a client."""
    options = (
        click.argument("task", required=False, shell_complete=complete_task),
        task_arguments,
        click.option(
            "--cell", metavar="NAME", shell_complete=complete_cell, help="The cell, unless the server has only one."
        ),
        click.option(
            "--goal", metavar="CONDITION", help="Instead of a task: plan for this goal, a condition, PDDL or JSON."
        ),
        click.option(
            "--skill", metavar="CALL", help="Instead of a task: call a skill, as in `Wipe(surface: lab:Table-1)`."
        ),
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
        callback=lambda context, _, value: _keep(context, _CELL, value),
    )
    return cell(server_options(function))


def asks_cell() -> bool:
    """Whether the options of the command name a cell or a server, so that it is a client."""
    meta = click.get_current_context().meta
    return _CELL in meta or _URL in meta


def refuse_options(**given: object) -> None:
    """Raise UsageError if an option is given that is not for a cell of a server."""
    for name, value in given.items():
        if value:
            raise click.UsageError(f"--{name.replace('_', '-')} cannot be used with a cell of a server")


@contextmanager
def asked_cell() -> Iterator[ServerCell]:
    """Return the cell that the options of the command name, in a `with` statement; errors as of `skillc.connect`."""
    with connect_server() as server:
        yield server.cell(click.get_current_context().meta.get(_CELL))


@contextmanager
def connect_server() -> Iterator[Server]:
    """Return the server that the options of the command name, in a `with` statement; errors as of `skillc.connect`."""
    from skillc.client.address import read_token_file
    from skillc.client.connecting import connect

    meta = click.get_current_context().meta
    url, file = meta.get(_URL), meta.get(_TOKEN_FILE)
    with connect(url, read_token_file(file) if file is not None else None) as server:
        yield server


def operation_argument(function: Function) -> Function:
    """Add OPERATION, which may be left out if only one goes on."""
    return click.argument("operation", required=False, metavar="[OPERATION]", shell_complete=complete_operation)(
        function
    )


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
    @operation_argument
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


def remark_status(status: OperationStatus) -> None:
    """Print how an operation is to stderr."""
    from skillc.cli.console import print_remark

    print_remark(f"{status.id}: {describe_state(status)}")


def remark_going_on(operation: str) -> None:
    """Print to stderr that an operation goes on without who watched it."""
    from skillc.cli.console import print_remark

    print_remark(f"{operation} goes on; `skillc attach` shows it, `skillc stop` stops it")


def describe_state(status: OperationStatus) -> str:
    """Return the state of an operation, and why it is in it."""
    from skillc_runtime.planning.progress import describe_progress
    from skillc_runtime.recording.known_facts import format_status

    words = format_status(status.state, status.verified)
    planning = "" if status.planning is None else describe_progress(status.planning)
    asked = [f"asks: {each.text} ({' | '.join(each.choices)})" for each in status.prompts]
    return ": ".join(filter(None, (words, status.reason, planning, *asked)))


def complete_operation(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the operations that go on, with how they are; none without a server."""
    found = _ask_server(context, lambda server: [each.last_status for each in server.ongoing()])
    return [CompletionItem(each.id, help=describe_state(each)) for each in found if each.id.startswith(begun)]


def complete_answer(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the choices of what the skills of operations ask; none without a server."""
    statuses = _ask_server(context, lambda server: [each.last_status for each in server.ongoing()])
    found = {choice: prompt.text for each in statuses for prompt in each.prompts for choice in prompt.choices}
    return [CompletionItem(choice, help=text) for choice, text in found.items() if choice.startswith(begun)]


def complete_order(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the orders of the cell of a command, with what they start; none without a server."""
    found = _ask_server(context, lambda server: server.cell(context.params.get("cell")).orders())
    offered = {each.id: each.order.request for each in found if each.id.startswith(begun)}
    return [CompletionItem(name, help=made.task or made.goal or made.call or "") for name, made in offered.items()]


def complete_cell(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the cells, with how they are; none without a server."""
    found = _ask_server(context, lambda server: server.cells())
    return [CompletionItem(each.name, help=each.state) for each in found if each.name.startswith(begun)]


def _ask_server(context: click.Context, ask: Callable[[Server], Sequence[Item]]) -> Sequence[Item]:
    """Return what the server of a command that is being completed answers; nothing without a server."""
    try:
        with context.scope(cleanup=False), connect_server() as server:
            return ask(server)
    except ServiceError:
        return ()


def _keep(context: click.Context, name: str, value: str | Path | None) -> None:
    if value is not None:
        context.meta[name] = value
