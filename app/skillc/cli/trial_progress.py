"""Shows the progress of trials on stderr: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import sys
from types import TracebackType

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from skillc.cli.console import find_display_obstacle, rich_console
from skillc.cli.settings import output_settings
from skillc_runtime.evaluation.trials.trial import Disturbance, Trial
from skillc_runtime.evaluation.trials.verdict import find_unmet_criteria


class TrialProgress:
    """Shows each finished trial: a bar on a terminal, a line elsewhere, nothing if `quiet`."""

    def __init__(self, task: str, disturbance: Disturbance, count: int, done: int, quiet: bool) -> None:
        self._console = rich_console(sys.stderr)
        self._disturbance, self._count, self._done = disturbance, count, done
        columns = (
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
        )
        self._is_quiet = quiet or output_settings().quiet
        hidden = self._is_quiet or find_display_obstacle() is not None
        self._bar = Progress(*columns, console=self._console, disable=hidden, transient=True)
        self._row = self._bar.add_task(task, total=self._count, completed=done)

    def __enter__(self) -> TrialProgress:
        self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.stop()

    def show_done(self, done: int) -> None:
        """Show how many trials are done, where no more is known of them."""
        self._done = done
        self._bar.update(self._row, completed=done)
        if self._bar.disable and not self._is_quiet:
            self._console.print(f"{done} of {self._count} trials done", soft_wrap=True)

    def __call__(self, trial: Trial) -> None:
        """Show a finished trial; on a terminal those that ended as expected only advance the bar."""
        self._done += 1
        self._bar.advance(self._row)
        why = find_unmet_criteria(trial, self._disturbance)
        if (why or self._bar.disable) and not self._is_quiet:
            line = f"seed {trial.seed}: {'; '.join(why) or 'passed'} ({self._done} of {self._count})"
            self._console.print(line, soft_wrap=True)
