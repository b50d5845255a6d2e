"""The cells of a server and their operations as text for the terminal, once or as they change."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence

import click
import msgspec

from skillc.cli.console import page_of, print_lines, rich_console
from skillc.cli.layout import Row, Style, TableCell, TerminalPage
from skillc.cli.output.operation_remarks import describe_state
from skillc.contract.cell import CellStatus
from skillc.contract.operation import OperationStatus
from skillc_runtime.execution.pace import FAST, format_pace
from skillc_runtime.recording.states import State

STYLES: dict[State, Style] = {"succeeded": "good", "failed": "bad", "interrupted": "bad", "paused": "warning"}


def print_cells(cells: Sequence[CellStatus], operations: Sequence[OperationStatus]) -> None:
    """Print cells and operations."""
    print_lines(format_cells(cells, operations, page_of(sys.stdout)))


def print_operations(operations: Sequence[OperationStatus]) -> None:
    """Print operations, a line for each."""
    print_lines(page_of(sys.stdout).columns([_operation_row(each) for each in operations]))


def format_cells(cells: Sequence[CellStatus], operations: Sequence[OperationStatus], page: TerminalPage) -> list[str]:
    """Return the lines of cells, and of operations below them."""
    lines = page.columns([_cell_row(each) for each in cells])
    for each in dict.fromkeys(each.library_problem for each in cells if each.library_problem):
        lines += ["", *_describe_problem(each).splitlines()]
    if operations:
        lines += ["", *page.columns([_operation_row(each) for each in operations])]
    return lines


def watch_cells(changes: Iterable[CellStatus | OperationStatus], as_json: bool) -> None:
    """Show how cells and operations are, as they change: on a terminal all of them, else a line for each change."""
    if as_json or not sys.stdout.isatty():
        for each in changes:
            click.echo(msgspec.json.encode(each) if as_json else _describe(each))
        return
    from rich.live import Live
    from rich.text import Text

    cells, operations = dict[str, CellStatus](), dict[str, OperationStatus]()
    page = page_of(sys.stdout)
    with Live(console=rich_console(sys.stdout), auto_refresh=False) as live:
        for each in changes:
            if isinstance(each, CellStatus):
                cells[each.name] = each
            else:
                operations[each.id] = each
            lines = format_cells(tuple(cells.values()), tuple(operations.values()), page)
            live.update(Text.from_ansi("\n".join(lines)), refresh=True)


def _cell_row(cell: CellStatus) -> Row:
    pace = format_pace(FAST if cell.pace is None else cell.pace)
    state = TableCell(cell.state, "" if cell.state == "operational" else "bad")
    return TableCell(cell.name, "name"), state, cell.library, cell.backend, f"pace {pace}", cell.reason


MAX_OBJECTIVE = 60
"""How many characters of a goal or a call are shown."""


def _operation_row(operation: OperationStatus) -> Row:
    request = operation.request
    what = " ".join((request.task or request.goal or request.call or "").split())
    what = what if len(what) <= MAX_OBJECTIVE else f"{what[:MAX_OBJECTIVE]}\N{HORIZONTAL ELLIPSIS}"
    state = TableCell(describe_state(operation), STYLES.get(operation.state, ""))
    return TableCell(operation.id, "name"), operation.cell, what, operation.request.owner, state


def _describe_problem(problem: str) -> str:
    return f"the library on disk is not used:\n{problem}"


def _describe(status: CellStatus | OperationStatus) -> str:
    if isinstance(status, OperationStatus):
        return f"{status.id}: {describe_state(status)}"
    problem = f"; {_describe_problem(status.library_problem)}" if status.library_problem else ""
    return f"{status.name}: {status.state}{f': {status.reason}' if status.reason else ''}{problem}"
