"""The tree of an operation as ROS 2 shows it: the nodes that have started, published when they change."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

import msgspec

from skillc.events import Event, NodeEnded, NodeStarted

PERIOD_S = 0.2
"""How often a tree that changes is published at most, in s."""


class StartedNodes:
    """The nodes of one operation; call it in an event loop, whose time decides when they are published."""

    def __init__(self, operation: str, publish: Callable[[bytes], None]) -> None:
        self._operation, self._publish = operation, publish
        self._nodes: dict[int, dict[str, Any]] = {}
        self._loop, self._due_s = asyncio.get_running_loop(), 0.0
        self._later: asyncio.TimerHandle | None = None

    def take(self, event: Event) -> None:
        """Take what has happened; a change is published at once, or when a period is over since the last one."""
        match event:
            case NodeStarted(node=node, parent=parent, kind=kind, name=name):
                self._nodes[node] = {"id": node, "parent": parent, "kind": kind, "name": name, "status": "running"}
            case NodeEnded(node=node, status=ended) if node in self._nodes:
                self._nodes[node]["status"] = ended
            case _:
                return
        if self._later is None:
            self._later = self._loop.call_at(max(self._due_s, self._loop.time()), self.show)

    def show(self) -> None:
        """Publish the nodes as they are now."""
        self.close()
        self._due_s = self._loop.time() + PERIOD_S
        self._publish(msgspec.json.encode({"operation": self._operation, "nodes": list(self._nodes.values())}))

    def close(self) -> None:
        """Publish no change any more that is waiting for its time."""
        if self._later is not None:
            self._later.cancel()
            self._later = None
