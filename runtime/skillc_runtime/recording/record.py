"""The nodes of a run as its events tell of them: who started whom, and what became of it at its last start."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from skillc_runtime.recording.events import ImplementationChosen, NodeEnded, NodeStarted, PlanMade
from skillc_runtime.recording.story import EarlierStart, Fact

EARLIER = 5
"""Of so many earlier starts of a call it is kept how they ended."""


@dataclass(slots=True, eq=False)
class NodeRecord:
    """A node at its last start, with those of its children that matter: calls, and what failed.

    `survived` tells that what was around it did not fail because of it.
    """

    start: NodeStarted
    parent: NodeRecord | None
    end: NodeEnded | None = None
    choice: ImplementationChosen | None = None
    facts: tuple[Fact, ...] = ()
    children: list[NodeRecord] = field(default_factory=list)
    starts: int = 1
    earlier: list[EarlierStart] = field(default_factory=list)
    survived: bool = False

    @property
    def is_call(self) -> bool:
        """Whether this is a call of a skill."""
        return self.start.kind == "call"

    @property
    def status(self) -> str:
        """What became of it."""
        return self.end.status if self.end is not None else "running"

    @property
    def calls(self) -> Iterator[NodeRecord]:
        """The calls below that no other call is between, in the order of their starts."""
        found = (each for child in self.children for each in ((child,) if child.is_call else child.calls))
        return iter(sorted(found, key=lambda each: (each.start.time, each.start.node)))


@dataclass(slots=True)
class AttemptRecord:
    """One attempt: the plan, if there was one, why it replaces the one before, its root and what it skipped."""

    plan: PlanMade | None = None
    replaces: str = ""
    roots: list[NodeRecord] = field(default_factory=list)
    skipped: list[NodeEnded] = field(default_factory=list)


class NodeRecords:
    """The nodes that run or matter; as many at most as the tree has when all of it has run, however long it runs."""

    def __init__(self, body: AttemptRecord) -> None:
        self._body = body
        self._known: dict[int, NodeRecord] = {}

    def start(self, event: NodeStarted) -> None:
        """A node starts: what an earlier start of it did is forgotten, but for the calls that may start again."""
        parent = self._known.get(event.parent)
        record = NodeRecord(event, parent)
        before = self._known.get(event.node)
        if before is not None:
            record.starts = before.starts + 1
            record.earlier = [*before.earlier, *_ended(before)][-EARLIER:]
            self._dissolve(before, [] if before.is_call else list(before.calls))
        self._known[event.node] = record
        self._siblings(record).append(record)

    def choose(self, event: ImplementationChosen) -> None:
        """A call starts with an implementation; of an earlier one that failed only the reason is kept, by the event."""
        record = self._known.get(event.node)
        if record is None:
            return
        record.choice = event
        for child in record.children:
            self._forget(child, frozenset())
        record.children.clear()

    def end(self, event: NodeEnded, facts: tuple[Fact, ...]) -> None:
        """A node ends; of one that is no call and did not fail only the calls below are kept."""
        record = self._known.get(event.node)
        if record is None:
            return
        record.end, record.facts = event, facts
        if record.is_call or event.status == "failure":
            return
        calls = list(record.calls)
        if record.start.kind == "if" and event.status == "success" and not calls and _outside(record):
            self._body.skipped.append(event)
        self._dissolve(record, calls)

    def _dissolve(self, record: NodeRecord, kept: list[NodeRecord]) -> None:
        """Put what is kept of a node into its place and forget the rest."""
        siblings = self._siblings(record)
        place = siblings.index(record)
        siblings[place : place + 1] = kept
        self._forget(record, frozenset(each.start.node for each in kept))
        for child in kept:
            child.parent, child.survived = record.parent, True

    def _forget(self, record: NodeRecord, kept: frozenset[int]) -> None:
        self._known.pop(record.start.node, None)
        for child in record.children:
            if child.start.node not in kept:
                self._forget(child, kept)

    def _siblings(self, record: NodeRecord) -> list[NodeRecord]:
        return record.parent.children if record.parent is not None else self._body.roots


def _outside(record: NodeRecord) -> bool:
    """Whether no call is around a node."""
    return record.parent is None or (not record.parent.is_call and _outside(record.parent))


def _ended(record: NodeRecord) -> tuple[EarlierStart, ...]:
    if record.end is None:
        return ()
    failure = record.end.failure
    return (
        EarlierStart(
            ended=record.end.time, status=record.status, message=failure.message if failure is not None else ""
        ),
    )
