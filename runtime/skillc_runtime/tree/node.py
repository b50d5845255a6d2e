"""The life of a node: it starts, ticks while it runs, and ends by itself or is halted."""

from __future__ import annotations

from typing import ClassVar

from skillc_compiler.library.vocabulary import Position
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import NodeEnded, NodeStarted
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.reasons import FailedCallContext
from skillc_runtime.tree.context import Context
from skillc_runtime.tree.errors import describe_exception

RUNNING, SUCCESS, FAILURE, HALTED = Status.RUNNING, Status.SUCCESS, Status.FAILURE, Status.HALTED


class Node:
    """A grounded node: started by the node `up` above it, ticked while it runs, until it ends by itself or is halted.

    A subclass writes `begin` and one of two. A node with work in each tick, such as watching several children or
    a condition, writes `tick`. A relay, which has one running child and decides when that ends, writes `lowest` and
    `after`, and is passed over while the child runs. All return RUNNING or what `end` or `fail` returns.
    Children start in the order of `children`.
    """

    kind: ClassVar[str]
    __slots__ = ("children", "context", "ended", "failure", "id", "name", "source", "started", "status", "up")

    def __init__(self, context: Context, source: Position, children: tuple[Node, ...] = (), name: str = "") -> None:
        self.context = context
        self.source = source
        self.children = children
        self.name = name or self.kind
        self.id = context.next_id()
        self.up: Node | None = None
        self.status = Status.IDLE
        self.failure: Failure | None = None
        self.started: float | None = None
        self.ended: float | None = None
        for child in children:
            child.up = self

    def start(self) -> Status:
        """Begin anew, do the first tick's work and return the status; a node that raises fails."""
        context = self.context
        self.status = RUNNING
        self.failure = None
        self.started, self.ended = context.time, None
        if context.emit is not None:
            parent = 0 if self.up is None else self.up.id
            started = NodeStarted(
                time=context.time, node=self.id, parent=parent, kind=self.kind, name=self.name, source=self.source
            )
            context.emit(started)
        try:
            return self.begin()
        except Exception as error:  # noqa: BLE001  a node is the boundary: it reports, halts and fails
            return self.broken(error)

    def begin(self) -> Status:
        """Do the work of `start`."""
        raise NotImplementedError

    def tick(self) -> Status:
        """Go on for one tick."""
        raise NotImplementedError

    def lowest(self) -> Node:
        """Return the node whose tick is next: this one, or for a relay the lowest of the child that runs."""
        return self

    def after(self, status: Status) -> Status:
        """Decide how to go on after the child of a relay ended with this status."""
        raise NotImplementedError

    def halt(self, reason: str) -> None:
        """Stop the node if it runs, with everything that runs below it, the last started first."""
        if self.status is RUNNING:
            self.stop(reason)
            self._settle(HALTED, Failure(kind="halted", message=reason, source=self.source))

    def stop(self, reason: str) -> None:
        """Halt what runs below; a subclass adds what it must undo itself. Never raises."""
        for child in reversed(self.children):
            child.halt(reason)

    def pause(self) -> None:
        """Tell everything that runs below to hold still."""
        for child in self.children:
            if child.status is RUNNING:
                child.pause()

    def resume(self) -> None:
        """Tell everything that runs below to go on."""
        for child in self.children:
            if child.status is RUNNING:
                child.resume()

    def still(self) -> bool:
        """Whether the node, finished, would end the same way in the world as it is now."""
        return self.status is SUCCESS

    def fails_still(self) -> bool:
        """Whether the node, failed, would fail again; asked by `invert` only."""
        return self.status is FAILURE

    def end(self) -> Status:
        """Record success."""
        return self._settle(SUCCESS, None)

    def fail(self, failure: Failure | None) -> Status:
        """Record a failure; None stands for a child that gave none."""
        return self._settle(FAILURE, failure or Failure(kind="body", message=f"{self.name} failed", source=self.source))

    def broken(self, error: Exception) -> Status:
        """Fail because of an exception: what runs below is halted first."""
        message = describe_exception(error)
        self.stop(message)
        return self.fail(Failure(kind="error", message=message, source=self.source))

    def attempted(self) -> FailedCallContext | None:
        """Return what a call that failed has to tell about it; asked when somebody listens."""
        return None

    def _settle(self, status: Status, failure: Failure | None) -> Status:
        context = self.context
        self.status, self.failure, self.ended = status, failure, context.time
        if context.emit is not None:
            ended = NodeEnded(
                time=context.time,
                node=self.id,
                name=self.name,
                status=status.value,
                failure=failure,
                attempted=self.attempted() if status is FAILURE else None,
                source=self.source,
            )
            context.emit(ended)
        return status
