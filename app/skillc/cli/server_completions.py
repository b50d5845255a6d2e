"""What a shell offers of what a server has; nothing without a server, or if it does not answer at once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from threading import Thread
from typing import TYPE_CHECKING, TypeVar

import click
from click.shell_completion import CompletionItem

from skillc.cli.completions import complete_task
from skillc.cli.output.operation_remarks import describe_state
from skillc.cli.server_connection import CELL, URL, connect_server
from skillc.errors import ServiceError

if TYPE_CHECKING:
    from skillc.client.cell import ServerCell
    from skillc.client.server import Server
    from skillc.contract.library import LibraryDescription, ParameterDescription
    from skillc.contract.operation import OperationStatus
    from skillc_runtime.recording.states import Decision

Item = TypeVar("Item")
Complete = Callable[[click.Context, click.Parameter, str], list[CompletionItem]]
PATIENCE_S = 10.0
"""How long a shell waits for the server, in s."""
SHOWN = 30
"""How many operations of each cell are offered."""


def complete_cell(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the cells, with how they are."""
    found = _ask_server(context, lambda server: server.cells())
    return _offer({each.name: each.state for each in found}, begun)


def complete_operation(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the operations that go on, with how they are."""
    return _offer_operations(_ask_server(context, _list_ongoing), begun)


def complete_any_operation(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the last operations of each cell, also those that have ended, with how they are."""
    return _offer_operations(_ask_server(context, _list_last), begun)


def complete_undecided(decision: Decision) -> Complete:
    """Return what offers the operations that a decision can continue: after a failure, or an interruption."""

    def ask(server: Server) -> Iterator[OperationStatus]:
        known = {each.id: each for each in (*_list_ongoing(server), *_list_last(server))}
        return (each for each in known.values() if decision in (*each.allowed, *each.decisions))

    def complete(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
        return _offer_operations(_ask_server(context, ask), begun)

    return complete


def complete_answer(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the choices of what the skills of operations ask."""
    statuses = _ask_server(context, _list_ongoing)
    return _offer({choice: each.text for it in statuses for each in it.prompts for choice in each.choices}, begun)


def complete_order(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the orders of the cell of a command, with what they start."""
    found = _ask_server(context, lambda server: server.cell(context.params.get("cell")).orders())
    requests = {each.id: each.order.request for each in found}
    return _offer({name: made.task or made.goal or made.call or "" for name, made in requests.items()}, begun)


def complete_job(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the jobs, with how they are."""
    return _offer({each.id: each.state for each in _ask_server(context, lambda server: server.jobs())}, begun)


def complete_checkpoint(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the checkpoints of the cell of a command, with who has saved them."""
    found = _ask_server(context, lambda server: server.cell(context.params.get("cell")).checkpoints())
    return _offer({each.name: each.who for each in found}, begun)


def complete_token(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the tokens, with their roles."""
    return _offer({each.name: each.role for each in _ask_server(context, lambda server: server.tokens())}, begun)


def complete_served_task(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the tasks of the libraries of the cells, with what they do."""
    libraries = _ask_server(context, lambda server: _list_libraries(server, context))
    return _offer({each.name: each.doc or each.goal for library in libraries for each in library.tasks}, begun)


def complete_asked_task(context: click.Context, parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the tasks of the server if the options name a cell or a server, else those here."""
    return (complete_served_task if _asks(context) else complete_task)(context, parameter, begun)


def complete_breakpoint(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the skills of the libraries of the cells, with what they do."""
    libraries = _ask_server(context, lambda server: _list_libraries(server, context))
    return _offer({each.name: each.doc for library in libraries for each in library.skills}, begun)


def complete_argument(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the parameters of the task that have no value yet; for one with `=` the individuals of its class."""
    name, equal, _value = begun.partition("=")
    given = context.params.get("arguments") or {}

    def ask(server: Server) -> Iterator[tuple[str, str]]:
        for cell, each in _find_parameters(server, context):
            if not equal and each.name not in given:
                yield f"{each.name}=", " ".join(filter(None, (each.type, each.doc)))
            elif equal and each.name == name:
                yield from ((f"{name}={label}", cls) for label, cls in _list_individuals(cell, each.type))

    return _offer(dict(_ask_server(context, ask)), begun)


def complete_asked_argument(context: click.Context, parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return what `complete_argument` does if the options name a cell or a server."""
    return complete_argument(context, parameter, begun) if _asks(context) else []


def complete_individual(context: click.Context, _parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Return the individuals of the cell of a command, with their classes; none without a cell."""

    def ask(server: Server) -> Iterator[tuple[str, str]]:
        return (each for cell in _list_cells(server, context) for each in _list_individuals(cell))

    return _offer(dict(_ask_server(context, ask)), begun) if _asks(context) else []


def _offer(found: dict[str, str], begun: str) -> list[CompletionItem]:
    """Return names, with what is said about each, that begin so."""
    return [CompletionItem(name, help=about) for name, about in found.items() if name.startswith(begun)]


def _offer_operations(found: Iterable[OperationStatus], begun: str) -> list[CompletionItem]:
    return _offer({each.id: describe_state(each) for each in found}, begun)


def _list_ongoing(server: Server) -> Sequence[OperationStatus]:
    return [each.last_status for each in server.ongoing()]


def _list_last(server: Server) -> Sequence[OperationStatus]:
    cells = [server.cell(each.name) for each in server.cells()]
    return [operation.last_status for cell in cells for operation in cell.operations(SHOWN)]


def _list_cells(server: Server, context: click.Context) -> Sequence[ServerCell]:
    """Return the cell that a command names, or all."""
    named = context.params.get("cell") or context.meta.get(CELL)
    return [server.cell(each) for each in ([named] if named else [each.name for each in server.cells()])]


def _list_libraries(server: Server, context: click.Context) -> Sequence[LibraryDescription]:
    """Return the libraries of the cells that answer."""
    found: list[LibraryDescription] = []
    for each in _list_cells(server, context):
        with suppress(ServiceError):
            found.append(each.library())
    return found


def _find_parameters(server: Server, context: click.Context) -> Iterator[tuple[ServerCell, ParameterDescription]]:
    """Yield the parameters of the task of a command, in the first cell that has it."""
    for cell in _list_cells(server, context):
        for task in cell.library().tasks:
            if task.name == context.params.get("task"):
                yield from ((cell, each) for each in task.parameters)
                return


def _list_individuals(cell: ServerCell, type: str | None = None) -> Iterator[tuple[str, str]]:
    """Yield the individuals of a cell, or those of a class, each with a class that it has."""
    from skillc_runtime.world.state.labels.labelled import LabelledClass

    for each in cell.facts(type=type):
        if isinstance(each.fact, LabelledClass):
            yield each.fact.individual.label, each.fact.cls.label


def _asks(context: click.Context) -> bool:
    return CELL in context.meta or URL in context.meta


def _ask_server(context: click.Context, ask: Callable[[Server], Iterable[Item]]) -> Sequence[Item]:
    """Return what the server of a command that is being completed answers within PATIENCE_S."""
    import skillc.client.async_server  # noqa: F401 - to import it takes none of the time of the server

    answer: list[Item] = []

    def wait() -> None:
        with suppress(ServiceError), context.scope(cleanup=False), connect_server() as server:
            answer.extend(ask(server))

    waiting = Thread(target=wait, daemon=True)
    waiting.start()
    waiting.join(PATIENCE_S)
    return tuple(answer)
