"""A user of a run who follows a script."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field

from skillc_runtime.execution.pace import Pace
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.events import Event

Script = Callable[[TaskRun, float], Sequence[Command]]


@dataclass
class Monitor:
    """Gives the commands that a script returns for a run and the time in its cell; remembers what is told."""

    script: Script = lambda _run, _now: ()
    pace: Pace = field(default_factory=Pace)
    told: list[str] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)

    def __call__(self, event: Event) -> None:
        self.events.append(event)

    def say(self, message: str) -> None:
        self.told.append(message)

    def operating(self) -> AbstractContextManager[None]:
        return nullcontext()

    def attend(self, run: TaskRun, now: float, seconds: float) -> Sequence[Command]:
        return self.script(run, now)
