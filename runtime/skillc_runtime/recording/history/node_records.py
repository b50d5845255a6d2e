"""Records of the nodes of a run, built from its events: a record for each start of a node, below its parent's."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from skillc_dsl.position import Position
from skillc_runtime.recording.events import ImplementationChosen, NodeEnded, NodeStarted, Note, PlanMade
from skillc_runtime.recording.failure import Failure, Rejection
from skillc_runtime.recording.history.history import LoopRound, RecordedFact
from skillc_runtime.recording.reasons import FailedCallContext
from skillc_runtime.world.state.labels.labelled import LabelledFact, LabelledIri, LabelledProperty

LOOPS = ("retry", "repeat", "while", "for")
"""The kinds of nodes of which each start of the child is a round."""


@dataclass(slots=True, eq=False)
class NodeRecord:
    """One start of a node; `children` are the starts of the nodes below it, in order of time.

    `choice` is the implementation that a call has started last; `given_up` is how many of the `children` belong to
    those before it. `written` are the facts on which its arguments rest that were written during the run; `found` are
    facts of its individuals that were sensed as it ended, if no call is inside of it. `round` is
    the one of the loop that is the parent, 0 elsewhere; `rounds` is how many have started in a loop.
    """

    start: NodeStarted
    parent: NodeRecord | None
    end: NodeEnded | None = None
    choice: ImplementationChosen | None = None
    facts: tuple[RecordedFact, ...] = ()
    written: tuple[RecordedFact, ...] = ()
    found: tuple[RecordedFact, ...] = ()
    children: list[NodeRecord] = field(default_factory=list)
    given_up: int = 0
    round: int = 0
    rounds: int = 0

    @property
    def is_call(self) -> bool:
        """Whether this is a call of a skill."""
        return self.start.kind == "call"

    @property
    def status(self) -> str:
        """How the node ended, or that it runs."""
        return self.end.status if self.end is not None else "running"

    @property
    def ended(self) -> float | None:
        """When the node ended, in s; None while it runs."""
        return self.end.time if self.end is not None else None

    @property
    def failure(self) -> Failure | None:
        """Why the node failed or was halted."""
        return self.end.failure if self.end is not None else None

    @property
    def failed_call(self) -> FailedCallContext | None:
        """The context of a call that failed."""
        return self.end.failed_call if self.end is not None else None

    @property
    def rejected(self) -> tuple[Rejection, ...]:
        """The implementations that a call could not use."""
        told = self.failed_call or self.choice
        return told.rejected if told is not None else ()

    @property
    def calls(self) -> Iterator[NodeRecord]:
        """The outermost calls below this node, in order of time."""
        for child in self.children:
            yield from (child,) if child.is_call else child.calls

    @property
    def latest(self) -> list[NodeRecord]:
        """The children that belong to the implementation that was chosen last."""
        return self.children[self.given_up :]

    @property
    def loop_rounds(self) -> tuple[LoopRound, ...]:
        """The rounds of the loops around this node in the same body, the outermost first."""
        found, node = list[LoopRound](), self
        while node.parent is not None and not (node is not self and node.is_call):
            if node.round:
                found.append(LoopRound(node.parent.start.name, node.round))
            node = node.parent
        return tuple(reversed(found))

    @property
    def scope_end(self) -> float | None:
        """When the scope ended that this call opened; None if it opened none, or the scope goes on."""
        scope = self.parent
        if scope is None or scope.start.kind != "with" or scope.children[0] is not self or scope.end is None:
            return None
        return scope.end.time


@dataclass(slots=True)
class AttemptRecord:
    """One attempt: its plan, if any, why it replaces the previous one, its root nodes, the steps it skipped, its notes.

    `decided` are the places of each `if` outside of calls that has succeeded: the branch that it did not take is not
    missed.
    """

    plan: PlanMade | None = None
    replaces: str = ""
    sensed: bool = False
    roots: list[NodeRecord] = field(default_factory=list)
    skipped: list[NodeEnded] = field(default_factory=list)
    decided: set[Position] = field(default_factory=set)
    notes: list[Note] = field(default_factory=list)


class NodeRecords:
    """The starts of the nodes of an attempt. Of a node that starts again, only the calls in its earlier starts stay."""

    def __init__(self, body: AttemptRecord) -> None:
        self._body = body
        self._last: dict[int, NodeRecord] = {}

    def start(self, event: NodeStarted) -> None:
        """Record that a node starts."""
        parent = self._last.get(event.parent)
        record = NodeRecord(event, parent)
        before = self._last.get(event.node)
        if before is not None:
            self._thin(before)
        if parent is not None and parent.start.kind in LOOPS:
            parent.rounds += 1
            record.round = parent.rounds
        self._last[event.node] = record
        self._siblings(record).append(record)

    def choose(self, event: ImplementationChosen, written: tuple[RecordedFact, ...]) -> None:
        """Record that a call starts with an implementation; what an earlier one has called stays.

        `written` are the facts that its expressions read and that were written during the run.
        """
        record = self._last.get(event.node)
        if record is not None:
            record.choice, record.written, record.given_up = event, written, len(record.children)

    def end(self, event: NodeEnded, facts: tuple[RecordedFact, ...], observed: Iterable[RecordedFact] = ()) -> None:
        """Record that a node ends, with the facts of its failure, and those that were written in the same tick."""
        record = self._last.get(event.node)
        if record is None:
            return
        record.end, record.facts = event, facts
        if record.choice is not None and not any(record.calls):
            own = {each.iri for each in record.choice.bindings.values() if isinstance(each, LabelledIri)}
            record.found = tuple(each for each in observed if _owner(each.fact) in own)
        if record.start.kind == "if" and event.status == "success" and _is_outside_calls(record):
            self._body.decided.add(event.source)
            if not any(record.calls):
                self._body.skipped.append(event)

    def _thin(self, record: NodeRecord) -> None:
        """Keep of an earlier start of a node only the calls in it and the nodes around them."""
        self._thin_below(record)
        if not record.is_call and not record.children:
            self._siblings(record).remove(record)

    def _thin_below(self, record: NodeRecord) -> None:
        if self._last.get(record.start.node) is record:
            del self._last[record.start.node]
        for child in record.children:
            self._thin_below(child)
        kept = [child.is_call or bool(child.children) for child in record.children]
        record.given_up = sum(kept[: record.given_up])
        record.children = [child for child, wanted in zip(record.children, kept, strict=True) if wanted]

    def _siblings(self, record: NodeRecord) -> list[NodeRecord]:
        return record.parent.children if record.parent is not None else self._body.roots


def _owner(fact: LabelledFact) -> str:
    """Return the IRI of the individual that a fact with a value is about; empty for others."""
    return fact.individual.iri if isinstance(fact, LabelledProperty) else ""


def _is_outside_calls(record: NodeRecord) -> bool:
    """Whether a node is not inside a call."""
    return record.parent is None or (not record.parent.is_call and _is_outside_calls(record.parent))
