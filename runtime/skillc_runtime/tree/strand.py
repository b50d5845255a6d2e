"""The line of running nodes below a node: its lowest is ticked directly, those above are asked only when it ends."""

from __future__ import annotations

from collections.abc import Callable

from skillc_runtime.primitives.primitive import Status
from skillc_runtime.tree.node import RUNNING, Node


class Strand:
    """A node ticks its child `top` by `tick`, or where speed counts by `pulse` and, unless that is RUNNING, `climb`.

    Nodes that only relay ticks to one child cost nothing while that child runs.
    """

    __slots__ = ("_lowest", "pulse", "top")

    def __init__(self, top: Node) -> None:
        self.top = top
        self._lowest = top
        self.pulse: Callable[[], Status] = top.tick

    def start(self) -> Status:
        """Start the child."""
        status = self.top.start()
        if status is RUNNING:
            self._hook()
        return status

    def tick(self) -> Status:
        """Tick the child."""
        status = self.pulse()
        return RUNNING if status is RUNNING else self.climb(status)

    def climb(self, status: Status) -> Status:
        """Let the relays above the lowest node, which ended, decide how to go on; return the status of the child."""
        node = self._lowest
        while status is not RUNNING and node is not self.top:
            assert node.up is not None, "a node below another one has one above"
            node = node.up
            status = node.after(status)
        if status is RUNNING:
            self._hook()
        return status

    def _hook(self) -> None:
        self._lowest = self.top.lowest()
        self.pulse = self._lowest.tick
