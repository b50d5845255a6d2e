"""The path of running nodes below a node: only its leaf is ticked; the nodes above are called when the leaf ends."""

from __future__ import annotations

from collections.abc import Callable

from skillc_runtime.execution.tree.node import RUNNING, Node
from skillc_runtime.primitives.primitive import Status


class ActivePath:
    """The path from a child, `top`, to the leaf that is ticked.

    The parent calls `tick`, or, for speed, `tick_leaf` followed by `propagate` unless the result is RUNNING.
    Nodes that only pass ticks on to one child cost nothing while that child runs.
    """

    __slots__ = ("_leaf", "tick_leaf", "top")

    def __init__(self, top: Node) -> None:
        self.top = top
        self._leaf = top
        self.tick_leaf: Callable[[], Status] = top.tick

    def start(self) -> Status:
        """Start the child."""
        status = self.top.start()
        if status is RUNNING:
            self._update_leaf()
        return status

    def tick(self) -> Status:
        """Tick the child."""
        status = self.tick_leaf()
        return RUNNING if status is RUNNING else self.propagate(status)

    def propagate(self, status: Status) -> Status:
        """Notify the nodes above the leaf that it ended, until one continues; return the status of the child."""
        node = self._leaf
        while status is not RUNNING and node is not self.top:
            assert node.parent is not None, "a node below `top` has a parent"
            node = node.parent
            status = node.on_child_ended(status)
        if status is RUNNING:
            self._update_leaf()
        return status

    def _update_leaf(self) -> None:
        self._leaf = self.top.active_leaf()
        self.tick_leaf = self._leaf.tick
