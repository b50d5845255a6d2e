"""Live progress of a run on stderr: one changing line on a terminal, a line a step elsewhere."""

from __future__ import annotations

import sys
import time
from types import TracebackType

from rich.status import Status as Spinner
from rich.text import Text

from skillc_runtime.commands._console import console
from skillc_runtime.recording.events import Event, NodeEnded, NodeStarted, PlanMade, Replanned, TaskEnded
from skillc_runtime.recording.known import format_status

STEP_DEPTH = 2
"""Calls this deep are told of where the output is no terminal: the steps of a plan and what they call."""


class Live:
    """A listener that shows which skills run; `real_time` makes simulated time pass no faster than the clock."""

    def __init__(self, title: str, quiet: bool, real_time: bool = False) -> None:
        self._console = console(stderr=True)
        self._title, self._quiet, self._real_time = title, quiet, real_time
        self._calls: dict[int, tuple[str, ...]] = {0: ()}
        self._spinner: Spinner | None = None
        self._began: float | None = None

    def __enter__(self) -> Live:
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
        """Say what happens before the first tick."""
        if self._spinner is not None:
            self._spinner.update(Text(f"{self._title}: {message}"))
        elif not self._quiet:
            self._console.print(f"{self._title}: {message}", soft_wrap=True)

    def __call__(self, event: Event) -> None:
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
        """Wait until the clock has caught up with simulated time, where that is wanted."""
        if self._real_time:
            self._began = time.monotonic() - now if self._began is None else self._began
            time.sleep(max(0.0, self._began + now - time.monotonic()))

    def _show(self, now: float, calls: tuple[str, ...]) -> None:
        stack = " > ".join(calls)
        if self._spinner is not None:
            self._spinner.update(Text(f"{self._title}  {now:6.1f} s  {stack}"))
        elif not self._quiet and len(calls) <= STEP_DEPTH:
            self._console.print(f"{self._title}  {now:6.1f} s  {stack}", soft_wrap=True)
