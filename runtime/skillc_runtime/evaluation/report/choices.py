"""What a report keeps of the events of a run: the last choice made at each node, and when nodes ran."""

from __future__ import annotations

from skillc_runtime.recording.events import Event, ImplementationChosen, NodeEnded, NodeStarted


class Choices(dict[int, ImplementationChosen]):
    """A listener that keeps the last choice made at each node; in a loop a node runs many times.

    `runs` are the times, from and to in s, of each run of a node that succeeded.
    """

    def __init__(self) -> None:
        super().__init__()
        self.runs: dict[int, list[tuple[float, float]]] = {}
        self._started: dict[int, float] = {}

    def __call__(self, event: Event) -> None:
        match event:
            case ImplementationChosen():
                self[event.node] = event
            case NodeStarted():
                self._started[event.node] = event.time
            case NodeEnded(status="success"):
                self.runs.setdefault(event.node, []).append((self._started[event.node], event.time))
            case _:
                pass
