"""Shows the progress of trials on stderr: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

from skillc.cli.progress.stderr import StderrProgress
from skillc_runtime.evaluation.trials.trial import Trial, TrialDisturbance
from skillc_runtime.evaluation.trials.verdict import find_unmet_criteria


class TrialProgress(StderrProgress):
    """Shows each finished trial: a bar on a terminal, a line elsewhere, nothing if `quiet`."""

    def __init__(self, task: str, disturbance: TrialDisturbance, count: int, done: int, quiet: bool) -> None:
        super().__init__(task, count, done, quiet)
        self._disturbance, self._count, self._done = disturbance, count, done

    def show_done(self, done: int) -> None:
        """Show how many trials are done, where no more is known of them."""
        self._done = done
        self._bar.update(self._row, completed=done)
        if self._prints_lines:
            self._console.print(f"{done} of {self._count} trials done", soft_wrap=True)

    def __call__(self, trial: Trial) -> None:
        """Show a finished trial; on a terminal those that ended as expected only advance the bar."""
        self._done += 1
        self._bar.advance(self._row)
        why = find_unmet_criteria(trial, self._disturbance)
        if (why or self._bar.disable) and not self._is_quiet:
            line = f"seed {trial.seed}: {'; '.join(why) or 'passed'} ({self._done} of {self._count})"
            self._console.print(line, soft_wrap=True)
