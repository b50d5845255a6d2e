"""Selectors: run the children in order until one succeeds, with memory or reactively."""

from __future__ import annotations

from typing import ClassVar

from skillc_runtime.execution.tree.active_path import ActivePath
from skillc_runtime.execution.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure


def combine_failures(node: Node) -> Failure:
    """Return the failure of a node whose children have all failed: its cause is that of the first that was tried."""
    failures = (child.failure for child in node.children if child.failure is not None)
    causes = tuple(sorted(failures, key=lambda each: each.is_unmet_need))
    message = causes[0].message if causes else "every alternative failed"
    return Failure(kind="body", message=message, source=node.source, causes=causes)


class SelectorNode(Node):
    """A selector with memory: a child that failed is not tried again."""

    kind: ClassVar[str] = "sel"
    __slots__ = ("_current", "_index")

    def on_start(self) -> Status:
        self._index = -1
        return self.on_child_ended(FAILURE)

    def active_leaf(self) -> Node:
        return self._current.active_leaf()

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and self._current.remains_satisfied()

    def on_child_ended(self, status: Status) -> Status:
        while status is FAILURE:
            self._index += 1
            if self._index == len(self.children):
                return self.fail(combine_failures(self))
            self._current = self.children[self._index]
            status = self._current.start()
        return RUNNING if status is RUNNING else self.succeed()


class ReactiveSelectorNode(Node):
    """Tries the children in order in each tick, even failed ones; an earlier one that can run halts a later one."""

    kind: ClassVar[str] = "reactive sel"
    __slots__ = ("_active", "_paths")

    def on_start(self) -> Status:
        self._paths = [ActivePath(child) for child in self.children]
        self._active = 0
        return self.tick()

    def tick(self) -> Status:
        for index, path in enumerate(self._paths):
            status = path.tick() if path.top.status is RUNNING else path.start()
            if status is not FAILURE:
                return self._continue_at(index, status)
        return self.fail(combine_failures(self))

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and self.children[self._active].remains_satisfied()

    def _continue_at(self, index: int, status: Status) -> Status:
        if index < self._active:
            self.children[self._active].halt(f"{self.children[index].name}, which comes before it, can run")
        self._active = index
        return RUNNING if status is RUNNING else self.succeed()
