"""A child that runs several times: at most one round begins in a tick, so that a tick's work is bounded."""

from __future__ import annotations

from typing import ClassVar

from skillc_compiler.library import tree
from skillc_compiler.library.vocabulary import Position
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.trace.failure import Failure
from skillc_runtime.tree.context import Context
from skillc_runtime.tree.enclosing import Enclosing, Frame
from skillc_runtime.tree.node import RUNNING, SUCCESS, Node
from skillc_runtime.tree.strand import Strand
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.values import Value


class LoopNode(Node):
    """Runs its child round after round. `after` says whether another one follows: RUNNING for one in the next tick."""

    __slots__ = ("_strand", "child", "rounds")

    def __init__(self, context: Context, source: Position, child: Node, name: str) -> None:
        super().__init__(context, source, (child,), name)
        self.child = child
        self.rounds = 0
        self._strand = Strand(child)

    def begin(self) -> Status:
        self.rounds = 0
        return self.next_round()

    def tick(self) -> Status:
        if self.child.status is RUNNING:
            status = self._strand.tick()
            return RUNNING if status is RUNNING else self.after(status)
        try:
            return self.next_round()
        except Exception as error:  # noqa: BLE001  a node is the boundary: it reports, halts and fails
            return self.broken(error)

    def run_round(self) -> Status:
        """Start the child once more."""
        self.rounds += 1
        status = self._strand.start()
        return RUNNING if status is RUNNING else self.after(status)

    def next_round(self) -> Status:
        """Start a round, or end because there is none left."""
        raise NotImplementedError


class RetryNode(LoopNode):
    """Again until the child succeeds, `count` times at most."""

    kind: ClassVar[str] = "retry"
    __slots__ = ("count",)

    def __init__(self, context: Context, node: tree.Retry, child: Node) -> None:
        super().__init__(context, node.source, child, f"retry {node.count}")
        self.count = node.count

    def next_round(self) -> Status:
        return self.run_round()

    def after(self, status: Status) -> Status:
        if status is SUCCESS:
            return self.end()
        return RUNNING if self.rounds < self.count else self.fail(self.child.failure)

    def still(self) -> bool:
        return self.status is SUCCESS and self.child.still()


class RepeatNode(LoopNode):
    """Again while the child succeeds, `count` times."""

    kind: ClassVar[str] = "repeat"
    __slots__ = ("count",)

    def __init__(self, context: Context, node: tree.Repeat, child: Node) -> None:
        super().__init__(context, node.source, child, f"repeat {node.count}")
        self.count = node.count

    def next_round(self) -> Status:
        return self.run_round() if self.rounds < self.count else self.end()

    def after(self, status: Status) -> Status:
        if status is not SUCCESS:
            return self.fail(self.child.failure)
        return RUNNING if self.rounds < self.count else self.end()


class WhileNode(LoopNode):
    """Again while the condition holds; fails when it still holds after `limit` rounds."""

    kind: ClassVar[str] = "while"
    __slots__ = ("frame", "node")

    def __init__(self, context: Context, node: tree.While, child: Node, enclosing: Enclosing) -> None:
        super().__init__(context, node.source, child, f"while {node.text}")
        self.node = node
        self.frame = enclosing.frame

    def next_round(self) -> Status:
        if not evaluate(self.node.condition, self.context.state, self.frame):
            return self.end()
        if self.rounds < self.node.limit:
            return self.run_round()
        message = f"`{self.node.text}` still holds after {self.node.limit} rounds"
        return self.fail(Failure(kind="body", message=message, source=self.source))

    def after(self, status: Status) -> Status:
        return RUNNING if status is SUCCESS else self.fail(self.child.failure)

    def still(self) -> bool:
        return self.status is SUCCESS and not evaluate(self.node.condition, self.context.state, self.frame)


class ForEachNode(LoopNode):
    """Once for every item, in a frame of its own; what the last round assigned is kept after the loop."""

    kind: ClassVar[str] = "for"
    __slots__ = ("_items", "inner", "node", "outer")

    def __init__(self, context: Context, node: tree.ForEach, child: Node, enclosing: Enclosing, inner: Frame) -> None:
        super().__init__(context, node.source, child, f"for {node.variable}")
        self.node = node
        self.outer = enclosing.frame
        self.inner = inner
        self._items: tuple[Value, ...] = ()

    def begin(self) -> Status:
        items = value_of(self.node.items, self.context.state, self.outer)
        if not isinstance(items, tuple):
            raise TypeError(f"`for {self.node.variable}` needs a list, not {items!r}")
        self._items = items
        return super().begin()

    def next_round(self) -> Status:
        if self.rounds == len(self._items):
            return self.end()
        self.inner.clear()
        self.inner.update(self.outer)
        self.inner[self.node.variable] = self._items[self.rounds]
        return self.run_round()

    def after(self, status: Status) -> Status:
        if status is not SUCCESS:
            return self.fail(self.child.failure)
        if self.rounds < len(self._items):
            return RUNNING
        self.outer.update({name: value for name, value in self.inner.items() if name != self.node.variable})
        return self.end()
