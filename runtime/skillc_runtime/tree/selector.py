"""Children in order until one succeeds, with memory or reactive."""

from __future__ import annotations

from typing import ClassVar

from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure
from skillc_runtime.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.tree.strand import Strand


def all_failed(node: Node) -> Failure:
    """Return the failure of a node all of whose children failed, with the reason of each."""
    causes = tuple(child.failure for child in node.children if child.failure is not None)
    reasons = "; ".join(cause.message for cause in causes)
    return Failure(kind="body", message=f"every alternative failed: {reasons}", source=node.source, causes=causes)


class SelectorNode(Node):
    """Goes on where it is; a child that failed is not tried again."""

    kind: ClassVar[str] = "sel"
    __slots__ = ("_current", "_index")

    def begin(self) -> Status:
        self._index = -1
        return self.after(FAILURE)

    def lowest(self) -> Node:
        return self._current.lowest()

    def still(self) -> bool:
        return self.status is SUCCESS and self._current.still()

    def after(self, status: Status) -> Status:
        while status is FAILURE:
            self._index += 1
            if self._index == len(self.children):
                return self.fail(all_failed(self))
            self._current = self.children[self._index]
            status = self._current.start()
        return RUNNING if status is RUNNING else self.end()


class ReactiveSelectorNode(Node):
    """Tries the children from the first each tick, those that failed before too; a later one that ran is halted."""

    kind: ClassVar[str] = "reactive sel"
    __slots__ = ("_active", "_strands")

    def begin(self) -> Status:
        self._strands = [Strand(child) for child in self.children]
        self._active = 0
        return self.tick()

    def tick(self) -> Status:
        for index, strand in enumerate(self._strands):
            status = strand.tick() if strand.top.status is RUNNING else strand.start()
            if status is not FAILURE:
                return self._stay_at(index, status)
        return self.fail(all_failed(self))

    def still(self) -> bool:
        return self.status is SUCCESS and self.children[self._active].still()

    def _stay_at(self, index: int, status: Status) -> Status:
        if index < self._active:
            self.children[self._active].halt(f"{self.children[index].name}, which comes before it, can run")
        self._active = index
        return RUNNING if status is RUNNING else self.end()
