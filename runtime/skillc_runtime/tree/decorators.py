"""Nodes that change the result of their only child or bound its time."""

from __future__ import annotations

from typing import ClassVar

from skillc_compiler.library import tree
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure
from skillc_runtime.tree.context import Context
from skillc_runtime.tree.enclosing import Enclosing
from skillc_runtime.tree.leaves import seconds_of
from skillc_runtime.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.tree.strand import Strand

_EPSILON_S = 1e-9


class TimeoutNode(Node):
    """Halts the child and fails when it still runs after the time."""

    kind: ClassVar[str] = "timeout"
    __slots__ = ("_deadline", "_strand", "child", "frame", "node")

    def __init__(self, context: Context, node: tree.Timeout, child: Node, enclosing: Enclosing) -> None:
        super().__init__(context, node.source, (child,))
        self.node = node
        self.child = child
        self.frame = enclosing.frame

    def begin(self) -> Status:
        seconds = seconds_of(self.node.seconds, self.context, self.frame)
        self.name = f"timeout {seconds:g} s"
        self._deadline = self.context.now + seconds - _EPSILON_S
        self._strand = Strand(self.child)
        return self.after(self._strand.start())

    def tick(self) -> Status:
        if self.context.now >= self._deadline:
            message = f"{self.child.name} was not done after {self.name.removeprefix('timeout ')}"
            self.stop(message)
            return self.fail(Failure(kind="timeout", message=message, source=self.source))
        status = self._strand.tick()
        return RUNNING if status is RUNNING else self.after(status)

    def still(self) -> bool:
        return self.status is SUCCESS and self.child.still()

    def after(self, status: Status) -> Status:
        if status is RUNNING:
            return RUNNING
        return self.end() if status is SUCCESS else self.fail(self.child.failure)


class TryNode(Node):
    """Turns the child's failure into success, except a broken hold."""

    kind: ClassVar[str] = "try"
    __slots__ = ("child",)

    def __init__(self, context: Context, node: tree.Try, child: Node) -> None:
        super().__init__(context, node.source, (child,))
        self.child = child

    def begin(self) -> Status:
        return self.after(self.child.start())

    def lowest(self) -> Node:
        return self.child.lowest()

    def still(self) -> bool:
        return self.status is SUCCESS and (self.child.status is FAILURE or self.child.still())

    def after(self, status: Status) -> Status:
        if status is RUNNING:
            return RUNNING
        failure = self.child.failure
        if failure is not None and failure.breaks_hold:
            return self.fail(failure)
        return self.end()


class InvertNode(Node):
    """Exchanges success and failure, except a broken hold."""

    kind: ClassVar[str] = "invert"
    __slots__ = ("child",)

    def __init__(self, context: Context, node: tree.Invert, child: Node) -> None:
        super().__init__(context, node.source, (child,))
        self.child = child

    def begin(self) -> Status:
        return self.after(self.child.start())

    def lowest(self) -> Node:
        return self.child.lowest()

    def still(self) -> bool:
        return self.status is SUCCESS and self.child.fails_still()

    def after(self, status: Status) -> Status:
        if status is RUNNING:
            return RUNNING
        if status is SUCCESS:
            message = f"{self.child.name} succeeded, which `invert` makes a failure"
            return self.fail(Failure(kind="body", message=message, source=self.source))
        failure = self.child.failure
        return self.fail(failure) if failure is not None and failure.breaks_hold else self.end()


class OnceNode(Node):
    """Runs the child to its end at most once in the life of the enclosing skill; afterwards returns its result.

    A child that was halted has no result and runs anew.
    """

    kind: ClassVar[str] = "once"
    __slots__ = ("child",)

    def __init__(self, context: Context, node: tree.Once, child: Node) -> None:
        super().__init__(context, node.source, (child,))
        self.child = child

    def begin(self) -> Status:
        done = self.child.status is SUCCESS or self.child.status is FAILURE
        return self.after(self.child.status if done else self.child.start())

    def lowest(self) -> Node:
        return self.child.lowest()

    def after(self, status: Status) -> Status:
        if status is RUNNING:
            return RUNNING
        return self.end() if status is SUCCESS else self.fail(self.child.failure)
