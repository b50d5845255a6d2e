"""The tree of a run with what became of each node, as a value for reports and views."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from skillc_rdf.vocabulary.types import Position
from skillc_runtime.recording.failure import Failure, Rejection


class Outcome(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What became of a node at its last start; `started` and `ended` in seconds of the cell's clock.

    `status` is one of idle, running, success, failure, halted. A call has `rejected` and as its child the body of
    the implementation that ran last.
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
    children: tuple[Outcome, ...] = ()

    def nodes(self) -> Iterator[Outcome]:
        """Yield this and everything below."""
        yield self
        for child in self.children:
            yield from child.nodes()
