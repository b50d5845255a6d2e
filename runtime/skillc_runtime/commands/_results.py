"""Results of tasks as tables and as JSON."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click
import msgspec

from skillc_runtime.commands._console import console
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.table import render


def show(results: Sequence[TaskResult], directory: Path | None) -> None:
    """Print a table for each result and where its report is."""
    terminal = console()
    for result in results:
        terminal.print(render(result))
        if directory is not None and result.status != "refused":
            click.echo(f"report: {directory / 'report.html'}\n")


def as_json(result: TaskResult) -> str:
    """Return a result as one JSON object."""
    return msgspec.json.format(msgspec.json.encode(result), indent=2).decode()


def list_as_json(results: Sequence[TaskResult]) -> str:
    """Return results as one JSON list."""
    return msgspec.json.format(msgspec.json.encode(list(results)), indent=2).decode()
