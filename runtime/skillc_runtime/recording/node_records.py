"""Records of the nodes of a run, built from its events: their parents, and their outcomes at their last starts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from skillc_runtime.recording.events import ImplementationChosen, NodeEnded, NodeStarted, PlanMade
from skillc_runtime.recording.history import EarlierStart, RecordedFact

MAX_EARLIER_STARTS = 5
"""For how many earlier starts of a call the outcome is kept."""


@dataclass(slots=True, eq=False)
class NodeRecord:
    """A node at its last start, with those of its children that are kept: calls, and failed nodes.

    `was_handled` if its failure did not make the enclosing node fail.
    """

    start: NodeStarted
    parent: NodeRecord | None
    end: NodeEnded | None = None
    choice: ImplementationChosen | None = None
    facts: tuple[RecordedFact, ...] = ()
    children: list[NodeRecord] = field(default_factory=list)
    starts: int = 1
    earlier: list[EarlierStart] = field(default_factory=list)
    was_handled: bool = False

    @property
    def is_call(self) -> bool:
        """Whether this is a call of a skill."""
        return self.start.kind == "call"

    @property
    def status(self) -> str:
        """The status of the node at its last start."""
        return self.end.status if self.end is not None else "running"

    @property
    def calls(self) -> Iterator[NodeRecord]:
        """The outermost calls below this node, in the order of their starts."""
        found = (each for child in self.children for each in ((child,) if child.is_call else child.calls))
        return iter(sorted(found, key=lambda each: (each.start.time, each.start.node)))


@dataclass(slots=True)
class AttemptRecord:
    """One attempt: its plan, if any, why it replaces the previous one, its root nodes and the steps it skipped."""

    plan: PlanMade | None = None
    replaces: str = ""
    roots: list[NodeRecord] = field(default_factory=list)
    skipped: list[NodeEnded] = field(default_factory=list)


class NodeRecords:
    """The nodes of an attempt that run or are kept; at most as many as the tree has, however long it runs."""

    def __init__(self, body: AttemptRecord) -> None:
        self._body = body
        self._by_node: dict[int, NodeRecord] = {}

    def start(self, event: NodeStarted) -> None:
        """Record that a node starts; records of its earlier start are dropped, except calls that may start again."""
        parent = self._by_node.get(event.parent)
        record = NodeRecord(event, parent)
        before = self._by_node.get(event.node)
        if before is not None:
            record.starts = before.starts + 1
            record.earlier = [*before.earlier, *_as_earlier_start(before)][-MAX_EARLIER_STARTS:]
            self._replace_by(before, [] if before.is_call else list(before.calls))
        self._by_node[event.node] = record
        self._siblings(record).append(record)

    def choose(self, event: ImplementationChosen) -> None:
        """Record that a call starts with an implementation; the records of an earlier implementation are dropped."""
        record = self._by_node.get(event.node)
        if record is None:
            return
        record.choice = event
        for child in record.children:
            self._drop(child, frozenset())
        record.children.clear()

    def end(self, event: NodeEnded, facts: tuple[RecordedFact, ...]) -> None:
        """Record that a node ends; if it is not a call and did not fail, only the calls below it are kept."""
        record = self._by_node.get(event.node)
        if record is None:
            return
        record.end, record.facts = event, facts
        if record.is_call or event.status == "failure":
            return
        calls = list(record.calls)
        if record.start.kind == "if" and event.status == "success" and not calls and _is_outside_calls(record):
            self._body.skipped.append(event)
        self._replace_by(record, calls)

    def _replace_by(self, record: NodeRecord, kept: list[NodeRecord]) -> None:
        """Replace a node by its descendants that are kept, and drop the rest."""
        siblings = self._siblings(record)
        place = siblings.index(record)
        siblings[place : place + 1] = kept
        self._drop(record, frozenset(each.start.node for each in kept))
        for child in kept:
            child.parent, child.was_handled = record.parent, True

    def _drop(self, record: NodeRecord, kept: frozenset[int]) -> None:
        self._by_node.pop(record.start.node, None)
        for child in record.children:
            if child.start.node not in kept:
                self._drop(child, kept)

    def _siblings(self, record: NodeRecord) -> list[NodeRecord]:
        return record.parent.children if record.parent is not None else self._body.roots


def _is_outside_calls(record: NodeRecord) -> bool:
    """Whether a node is not inside a call."""
    return record.parent is None or (not record.parent.is_call and _is_outside_calls(record.parent))


def _as_earlier_start(record: NodeRecord) -> tuple[EarlierStart, ...]:
    if record.end is None:
        return ()
    failure = record.end.failure
    return (
        EarlierStart(
            ended=record.end.time, status=record.status, message=failure.message if failure is not None else ""
        ),
    )
