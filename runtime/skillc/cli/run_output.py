"""Runs a task with progress on stderr, and prints its result as a table."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from skillc.cli.console import Terminal, rich_console
from skillc.cli.keyboard import is_operable
from skillc.cli.run_progress import RunProgress
from skillc.services.errors import RequestError
from skillc.services.run_report import RunResult
from skillc.services.running import RunOptions, run_task
from skillc.services.task_loading import LoadedTask
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.table import render_table
from skillc_runtime.execution.pace import Pace


def check_operable(options: RunOptions) -> None:
    """Raise RequestError if a run would pause and nobody could let it go on: keys need a terminal and its display."""
    wanted = "--step" if options.step else "--pause-at" if options.pause_at else None
    if wanted is None:
        return
    if options.prints_json:
        raise RequestError(f"{wanted} cannot be used with --json, which shows no run and takes no keys")
    if not is_operable():
        raise RequestError(
            f"{wanted} requires a terminal as standard input and stderr: nobody could let the task go on after a pause"
        )


def run_with_progress(loaded: LoadedTask, options: RunOptions, quiet: bool, pace: Pace | None = None) -> RunResult:
    """Run a task and show its progress on stderr, unless `quiet`."""
    with RunProgress(loaded.assignment.name, quiet, pace) as progress:
        return run_task(loaded, options, progress, Terminal())


def print_results(results: Sequence[TaskResult], folder: Path | None, verbose: bool = False) -> None:
    """Print a table for each result, with all details of failures if `verbose`, and the path of its report."""
    console = rich_console()
    for result in results:
        console.print(render_table(result, verbose))
        if folder is not None:
            click.echo(f"report: {folder / 'report.html'}\n")
