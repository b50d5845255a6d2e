"""The tree of a run with the outcome of each node, as a value for reports and views."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from skillc_dsl.position import Position
from skillc_runtime.recording.failure import Failure, Rejection


class NodeOutcome(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """The outcome of a node at its last start; `started` and `ended` are in s of the cell's clock.

    `status` is idle, running, success, failure or halted. A call has `rejected` implementations, and as its child the
    body of the implementation that ran last. In a tree that is made from events, each start of a call is a node of its
    own, a call has the bodies of all its implementations that ran, and a step that was not needed is `skipped`.
    """

    id: int
    name: str
    kind: str
    status: str
    source: Position
    started: float | None = None
    ended: float | None = None
    failure: Failure | None = None
    rejected: tuple[Rejection, ...] = ()
    children: tuple[NodeOutcome, ...] = ()

    def nodes(self) -> Iterator[NodeOutcome]:
        """Yield this node and its descendants."""
        yield self
        for child in self.children:
            yield from child.nodes()
