"""Sequences: run the children in order until one fails, with memory or reactively."""

from __future__ import annotations

from typing import ClassVar

from skillc_runtime.execution.tree.active_path import ActivePath
from skillc_runtime.execution.tree.node import RUNNING, SUCCESS, Node
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS


class SequenceNode(Node):
    """A sequence with memory: a child that succeeded is not ticked again."""

    kind: ClassVar[str] = "seq"
    __slots__ = ("_current", "_index")

    def on_start(self) -> Status:
        self._index = -1
        return self.on_child_ended(SUCCESS)

    def active_leaf(self) -> Node:
        return self._current.active_leaf()

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and all(child.remains_satisfied() for child in self.children)

    def on_child_ended(self, status: Status) -> Status:
        while status is SUCCESS:
            self._index += 1
            if self._index == len(self.children):
                return self.succeed()
            self._current = self.children[self._index]
            status = self._current.start()
        return RUNNING if status is RUNNING else self.fail(self._current.failure)


class ReactiveSequenceNode(Node):
    """Visits the children in order in each tick; a succeeded child starts again if its result is no longer valid."""

    kind: ClassVar[str] = "reactive seq"
    __slots__ = ("_active", "_done", "_paths")

    def on_start(self) -> Status:
        self._paths = [ActivePath(child) for child in self.children]
        self._done = [False] * len(self.children)
        self._active = 0
        return self.tick()

    def tick(self) -> Status:
        try:
            return self._tick_children()
        except FOREIGN_ERRORS as error:  # a node is the boundary: it reports, halts and fails
            return self.fail_with_error(error)

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and all(child.remains_satisfied() for child in self.children)

    def _tick_children(self) -> Status:
        for index, path in enumerate(self._paths):
            if path.top.status is RUNNING:
                status = path.tick()
            elif self._done[index] and path.top.remains_satisfied():
                continue
            else:
                self._done[index] = False
                status = path.start()
            if status is not SUCCESS:
                return self._continue_at(index, status)
            self._done[index] = True
        return self.succeed()

    def _continue_at(self, index: int, status: Status) -> Status:
        if index < self._active:
            self.children[self._active].halt(f"{self.children[index].name}, which comes before it, runs again")
        self._active = index
        return RUNNING if status is RUNNING else self.fail(self.children[index].failure)
