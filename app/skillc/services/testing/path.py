"""The calls of a run, in order, with how each ended: the path that led to its end."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from skillc_dsl.position import Position
from skillc_runtime.recording.events import Event, NodeEnded, NodeStarted


@dataclass(slots=True)
class TakenCall:
    """A call that has started; `around` is the number of the node around it. It has not ended without a `status`."""

    node: int
    around: int
    name: str
    source: Position
    began_s: float
    status: str = ""
    ended_s: float = 0.0
    why: str = ""


@dataclass(slots=True)
class CallPath:
    """A listener that keeps the calls of a run, in the order in which they started."""

    calls: dict[int, TakenCall] = field(default_factory=dict)
    _around: dict[int, int] = field(default_factory=dict)

    def __call__(self, event: Event) -> None:
        """Receive an event."""
        match event:
            case NodeStarted(node=node, parent=parent, kind=kind):
                self._around[node] = parent
                if kind == "call":
                    self.calls[node] = TakenCall(node, parent, event.name, event.source, event.time)
            case NodeEnded(node=node) if node in self.calls:
                call = self.calls[node]
                call.name, call.status, call.ended_s = event.name, event.status, event.time
                call.why = event.failure.message if event.failure is not None else ""
            case _:
                pass

    @property
    def steps(self) -> tuple[TakenCall, ...]:
        """The outermost calls, in order."""
        return tuple(each for each in self.calls.values() if not any(self._calls_around(each)))

    @property
    def failed(self) -> tuple[TakenCall, ...]:
        """The calls that failed, the outermost of the last step that did first, each inside the one before."""
        steps = [each for each in self.steps if each.status == "failure"]
        chain = steps[-1:]
        while chain:
            inside = [each for each in self.calls.values() if each.status == "failure"]
            inside = [each for each in inside if next(self._calls_around(each), None) is chain[-1]]
            if not inside:
                break
            chain.append(inside[-1])
        return tuple(chain)

    def find_last(self, skill: str) -> TakenCall | None:
        """Return the call of a skill that ended last; None if there is none, or if several ended together."""
        calls = [each for each in self.calls.values() if each.name.partition("[")[0] == skill]
        last_s = max((each.ended_s for each in calls), default=0.0)
        last = [each for each in calls if each.ended_s == last_s]
        return last[0] if len(last) == 1 else None

    def _calls_around(self, call: TakenCall) -> Iterator[TakenCall]:
        """Yield the calls around a call, the innermost first."""
        node = call.around
        while node:
            if node in self.calls:
                yield self.calls[node]
            node = self._around.get(node, 0)
