"""Collects from the events of a run the last implementation chosen at each node, when nodes ran, and its pauses."""

from __future__ import annotations

from math import inf

from skillc_runtime.evaluation.metrics.intervals import Interval
from skillc_runtime.recording.events import (
    Event,
    ImplementationChosen,
    NodeEnded,
    NodeStarted,
    Paused,
    Resumed,
)


class ChoiceListener(dict[int, ImplementationChosen]):
    """A listener that maps each node to its last choice; in a loop a node runs many times.

    `runs` are the start and end times in s of each successful run of a node; `pauses` are the intervals in which the
    run was paused, the last one without an end if it never went on.
    """

    def __init__(self) -> None:
        super().__init__()
        self.runs: dict[int, list[Interval]] = {}
        self.pauses: list[Interval] = []
        self._started: dict[int, float] = {}

    def __call__(self, event: Event) -> None:
        match event:
            case ImplementationChosen():
                self[event.node] = event
            case NodeStarted():
                self._started[event.node] = event.time
            case NodeEnded(status="success"):
                self.runs.setdefault(event.node, []).append((self._started[event.node], event.time))
            case Paused():
                self.pauses.append((event.time, inf))
            case Resumed():
                self.pauses[-1] = (self.pauses[-1][0], event.time)
            case _:
                pass
