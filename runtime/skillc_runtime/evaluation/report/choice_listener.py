"""Collects from the events of a run the last implementation chosen at each node, and when nodes ran."""

from __future__ import annotations

from skillc_runtime.recording.events import Event, ImplementationChosen, NodeEnded, NodeStarted


class ChoiceListener(dict[int, ImplementationChosen]):
    """A listener that maps each node to its last choice; in a loop a node runs many times.

    `runs` are the start and end times in s of each successful run of a node.
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
