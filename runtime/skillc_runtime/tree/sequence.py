"""Children in order until one fails, with memory or reactive."""

from __future__ import annotations

from typing import ClassVar

from skillc_runtime.primitives.primitive import Status
from skillc_runtime.tree.node import RUNNING, SUCCESS, Node
from skillc_runtime.tree.strand import Strand


class SequenceNode(Node):
    """Goes on where it is; a child that finished is not looked at again."""

    kind: ClassVar[str] = "seq"
    __slots__ = ("_current", "_index")

    def begin(self) -> Status:
        self._index = -1
        return self.after(SUCCESS)

    def lowest(self) -> Node:
        return self._current.lowest()

    def still(self) -> bool:
        return self.status is SUCCESS and all(child.still() for child in self.children)

    def after(self, status: Status) -> Status:
        while status is SUCCESS:
            self._index += 1
            if self._index == len(self.children):
                return self.end()
            self._current = self.children[self._index]
            status = self._current.start()
        return RUNNING if status is RUNNING else self.fail(self._current.failure)


class ReactiveSequenceNode(Node):
    """Looks at every child each tick, from the first; a finished one starts anew only if its result no longer holds."""

    kind: ClassVar[str] = "reactive seq"
    __slots__ = ("_active", "_done", "_strands")

    def begin(self) -> Status:
        self._strands = [Strand(child) for child in self.children]
        self._done = [False] * len(self.children)
        self._active = 0
        return self.tick()

    def tick(self) -> Status:
        try:
            return self._tick_from_first()
        except Exception as error:  # noqa: BLE001  a node is the boundary: it reports, halts and fails
            return self.broken(error)

    def still(self) -> bool:
        return self.status is SUCCESS and all(child.still() for child in self.children)

    def _tick_from_first(self) -> Status:
        for index, strand in enumerate(self._strands):
            if strand.top.status is RUNNING:
                status = strand.tick()
            elif self._done[index] and strand.top.still():
                continue
            else:
                self._done[index] = False
                status = strand.start()
            if status is not SUCCESS:
                return self._stay_at(index, status)
            self._done[index] = True
        return self.end()

    def _stay_at(self, index: int, status: Status) -> Status:
        if index < self._active:
            self.children[self._active].halt(f"{self.children[index].name}, which comes before it, runs again")
        self._active = index
        return RUNNING if status is RUNNING else self.fail(self.children[index].failure)
