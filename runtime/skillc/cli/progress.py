"""Shows the progress of runs and trials on stderr: a spinner or bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType, TracebackType

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.status import Status as Spinner
from rich.text import Text

from skillc.cli.console import rich_console
from skillc_runtime.evaluation.trials.trial import Disturbance, Trial
from skillc_runtime.evaluation.trials.verdict import find_unmet_criteria
from skillc_runtime.recording.events import Event, NodeEnded, NodeStarted, PlanMade, Replanned, TaskEnded
from skillc_runtime.recording.known_facts import format_status

STEP_DEPTH = 2
"""The greatest depth of calls shown if stderr is not a terminal: the steps of a plan and the calls in them."""


class RunProgress:
    """The monitor of a run, which shows the active skills; with `real_time` it slows the run to real time."""

    def __init__(self, title: str, quiet: bool, real_time: bool = False) -> None:
        self._console = rich_console(stderr=True)
        self._title, self._quiet, self._real_time = title, quiet, real_time
        self._calls: dict[int, tuple[str, ...]] = {0: ()}
        self._spinner: Spinner | None = None
        self._began: float | None = None

    def __enter__(self) -> RunProgress:
        if not self._quiet and sys.stderr.isatty():
            self._spinner = self._console.status(Text(f"{self._title}: preparing"))
            self._spinner.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._spinner is not None:
            self._spinner.stop()

    def say(self, message: str) -> None:
        """Show a message."""
        if self._spinner is not None:
            self._spinner.update(Text(f"{self._title}: {message}"))
        elif not self._quiet:
            self._console.print(f"{self._title}: {message}", soft_wrap=True)

    def __call__(self, event: Event) -> None:
        """Show an event."""
        match event:
            case NodeStarted(node=node, parent=parent, kind=kind, name=name):
                around = self._calls.get(parent, ())
                self._calls[node] = (*around, name) if kind == "call" else around
                if kind == "call":
                    self._show(event.time, self._calls[node])
            case NodeEnded(node=node):
                self._calls.pop(node, None)
            case Replanned(reason=reason):
                self.say(f"planning again: {reason}")
            case PlanMade(steps=steps, quality=quality):
                self.say(f"{' -> '.join(step.skill for step in steps)} ({quality})")
            case TaskEnded(status=status, verified=verified):
                self.say(format_status(status, verified))
            case _:
                pass

    def pace(self, now: float) -> None:
        """Wait, with `real_time`, until the wall clock has caught up with `now`, the simulated time in s."""
        if self._real_time:
            self._began = time.monotonic() - now if self._began is None else self._began
            time.sleep(max(0.0, self._began + now - time.monotonic()))

    @contextmanager
    def interruption(self) -> Iterator[Callable[[], bool]]:
        """Turn the first Ctrl-C into a request to halt; the second one raises KeyboardInterrupt."""
        wanted = False

        def interrupt(_signal: int, _frame: FrameType | None) -> None:
            nonlocal wanted
            if wanted:
                raise KeyboardInterrupt
            wanted = True

        before = signal.signal(signal.SIGINT, interrupt)
        try:
            yield lambda: wanted
        finally:
            signal.signal(signal.SIGINT, before)

    def _show(self, now: float, calls: tuple[str, ...]) -> None:
        stack = " > ".join(calls)
        if self._spinner is not None:
            self._spinner.update(Text(f"{self._title}  {now:6.1f} s  {stack}"))
        elif not self._quiet and len(calls) <= STEP_DEPTH:
            self._console.print(f"{self._title}  {now:6.1f} s  {stack}", soft_wrap=True)


class TrialProgress:
    """Shows each finished trial: a bar on a terminal, a line elsewhere, nothing if `quiet`."""

    def __init__(self, task: str, disturbance: Disturbance, count: int, done: int, quiet: bool) -> None:
        self._console = rich_console(stderr=True, quiet=quiet)
        self._disturbance, self._count, self._done = disturbance, count, done
        columns = (
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
        )
        self._bar = Progress(*columns, console=self._console, disable=quiet or not sys.stderr.isatty())
        self._row = self._bar.add_task(task, total=self._count, completed=done)

    def __enter__(self) -> TrialProgress:
        self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.stop()

    def __call__(self, trial: Trial) -> None:
        """Show a finished trial; on a terminal those that ended as expected only advance the bar."""
        self._done += 1
        self._bar.advance(self._row)
        why = find_unmet_criteria(trial, self._disturbance)
        if why or self._bar.disable:
            line = f"seed {trial.seed}: {'; '.join(why) or 'passed'} ({self._done} of {self._count})"
            self._console.print(line, soft_wrap=True)
