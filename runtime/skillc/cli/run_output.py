"""Runs a task with progress on stderr, and prints its result as a table."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from skillc.cli.console import Terminal, rich_console
from skillc.cli.progress import RunProgress
from skillc.services.running import RunOptions, RunResult, run_task
from skillc.services.task_loading import LoadedTask
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.table import render_table


def run_with_progress(loaded: LoadedTask, options: RunOptions, quiet: bool, real_time: bool = False) -> RunResult:
    """Run a task and show its progress on stderr, unless `quiet`."""
    with RunProgress(loaded.assignment.name, quiet, real_time) as progress:
        return run_task(loaded, options, progress, Terminal())


def print_results(results: Sequence[TaskResult], folder: Path | None) -> None:
    """Print a table for each result, and the path of its report."""
    console = rich_console()
    for result in results:
        console.print(render_table(result))
        if folder is not None and result.status != "refused":
            click.echo(f"report: {folder / 'report.html'}\n")
