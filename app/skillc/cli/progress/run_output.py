"""Runs a task with progress on stderr, and prints its result."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from skillc.cli.console import Terminal, find_display_obstacle, page_of, print_result
from skillc.cli.progress.run_progress import RunProgress
from skillc.cli.settings import output_settings
from skillc.errors import RequestError
from skillc.services.recording.picture_making import Pictures
from skillc.services.run.result import ReportedRun
from skillc.services.run.running import RunOptions, run_task
from skillc.services.tasks.loading import LoadedTask
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.execution.pace import Pace, parse_pace
from skillc_runtime.platforms.keyboard import is_operable


def check_operable(options: RunOptions) -> None:
    """Raise RequestError if a run would pause and nobody could let it go on: keys need a terminal and its display."""
    spec = options.spec
    pausing = {"--step": spec.step, "--breakpoints": spec.breakpoints, "--confirm-steps": spec.confirm_steps}
    wanted = next((option for option, given in pausing.items() if given), None)
    if wanted is None:
        return
    if options.prints_json:
        raise RequestError(f"{wanted} cannot be used with --json, which shows no run and takes no keys")
    obstacle = find_display_obstacle() or (None if is_operable() else "no keys can be read from the standard input")
    if obstacle is not None:
        raise RequestError(
            f"{wanted} requires a terminal that shows the run and takes keys, but {obstacle}: "
            "nobody could let the task go on after a pause"
        )


def run_with_progress(loaded: LoadedTask, options: RunOptions, quiet: bool, pictures: Pictures) -> ReportedRun:
    """Run a task and show its progress on stderr, unless `quiet`; its film may still be made afterwards."""
    pace = Pace(parse_pace(options.spec.pace))
    name = loaded.assignment.name
    with RunProgress(f"{name} (dry)" if options.spec.dry else name, quiet, pace) as progress:
        return run_task(loaded, options, progress, Terminal(), pictures)


def print_results(results: Sequence[TaskResult], folder: Path | None) -> None:
    """Print how each task ended with its steps and numbers, only how it ended if quiet, and the path of its report."""
    from skillc.cli.output.result import format_ending, format_result

    page, settings = page_of(sys.stdout), output_settings()
    report = "" if folder is None else f"report: {folder / 'report.html'}"
    for number, result in enumerate(results):
        text = format_ending(result, page) if settings.quiet else format_result(result, page, settings.verbose)
        parts = [text, report] if report else [text]
        print_result(("\n" if number else "") + ("\n" if settings.quiet else "\n\n").join(parts))
