"""Loops: at most one round starts per tick, so that the work per tick is bounded."""

from __future__ import annotations

from typing import ClassVar

from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.conditions import Expression
from skillc_model.tree import MOST_ROUNDS
from skillc_runtime.execution.tree.active_path import ActivePath
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.lexical_scope import Frame, LexicalScope
from skillc_runtime.execution.tree.locks import Holders
from skillc_runtime.execution.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.planning.moved_things import has_moved
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS
from skillc_runtime.world.state.values import Value


class LoopNode(Node):
    """Runs its child in rounds; `on_child_ended` returns RUNNING if another round follows in the next tick."""

    __slots__ = ("_path", "child", "rounds")

    def __init__(self, context: TreeContext, source: Position, child: Node, name: str) -> None:
        super().__init__(context, source, (child,), name)
        self.child = child
        self.rounds = 0
        self._path = ActivePath(child)

    def on_start(self) -> Status:
        self.rounds = 0
        return self.next_round()

    def tick(self) -> Status:
        if self.child.status is RUNNING:
            status = self._path.tick()
            return RUNNING if status is RUNNING else self.on_child_ended(status)
        try:
            return self.next_round()
        except FOREIGN_ERRORS as error:  # a node is the boundary: it reports, halts and fails
            return self.fail_with_error(error)

    def start_round(self) -> Status:
        """Start the child for another round."""
        self.rounds += 1
        status = self._path.start()
        return RUNNING if status is RUNNING else self.on_child_ended(status)

    def foresee_round(self, freed: Holders, is_only: bool) -> Status:
        """Return how the first round would begin; unless it is the only one, what follows begins in another tick."""
        status = self.child.dry_start(freed)
        return RUNNING if status is SUCCESS and not is_only else status

    def next_round(self) -> Status:
        """Start a round, or end if none is left."""
        raise NotImplementedError


def evaluate_rounds(written: int | Expression, kind: str, context: TreeContext, frame: Frame) -> int:
    """Return the number of rounds of a loop. Raises ValueError if it is none."""
    if isinstance(written, int):
        return written
    count = value_of(written, context.state, frame)
    if isinstance(count, bool) or not isinstance(count, int) or not 1 <= count <= MOST_ROUNDS:
        raise ValueError(f"`{kind}` needs a whole number of rounds from 1 to a million, not {count!r}")
    return count


class CountedNode(LoopNode):
    """A loop whose number of rounds is computed when it starts."""

    __slots__ = ("_written", "count", "frame")

    def __init__(self, context: TreeContext, node: tree.Retry | tree.Repeat, child: Node, scope: LexicalScope) -> None:
        super().__init__(context, node.source, child, self.kind)
        self._written, self.frame, self.count = node.count, scope.frame, 0
        if isinstance(node.count, int):
            self.name = f"{self.kind} {node.count}"

    def on_start(self) -> Status:
        self.count = self.evaluate_count()
        self.name = f"{self.kind} {self.count}"
        return super().on_start()

    def evaluate_count(self) -> int:
        """Return the number of rounds. Raises ValueError if it is none."""
        return evaluate_rounds(self._written, self.kind, self.context, self.frame)


class RetryNode(CountedNode):
    """Repeats the child until it succeeds, at most `count` times.

    A child that lacked space is not repeated unless something stands elsewhere than when its round began.
    """

    kind: ClassVar[str] = "retry"
    __slots__ = ("_began",)

    def foresee(self, freed: Holders) -> Status:
        self.evaluate_count()
        return self.child.dry_start(freed)

    def next_round(self) -> Status:
        self._began = self.context.state
        return self.start_round()

    def on_child_ended(self, status: Status) -> Status:
        if status is SUCCESS:
            return self.succeed()
        return RUNNING if self.rounds < self.count and self._may_succeed() else self.fail(self.child.failure)

    def _may_succeed(self) -> bool:
        """Whether there is a reason why another round may end differently."""
        failure = self.child.failure
        if failure is None or not failure.lacks_space or has_moved(self._began, self.context.cell.world.snapshot()):
            return True
        self.context.note("not again: it would lack the same space, nothing stands elsewhere", self.id, self.source)
        return False

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and self.child.remains_satisfied()


class RepeatNode(CountedNode):
    """Repeats the child `count` times while it succeeds."""

    kind: ClassVar[str] = "repeat"
    __slots__ = ()

    def foresee(self, freed: Holders) -> Status:
        count = self.evaluate_count()
        return SUCCESS if count == 0 else self.foresee_round(freed, is_only=count == 1)

    def next_round(self) -> Status:
        return self.start_round() if self.rounds < self.count else self.succeed()

    def on_child_ended(self, status: Status) -> Status:
        if status is not SUCCESS:
            return self.fail(self.child.failure)
        return RUNNING if self.rounds < self.count else self.succeed()


class WhileNode(LoopNode):
    """Repeats the child while the condition is true; fails if it is still true after `limit` rounds."""

    kind: ClassVar[str] = "while"
    __slots__ = ("_limit", "frame", "node")

    def __init__(self, context: TreeContext, node: tree.While, child: Node, scope: LexicalScope) -> None:
        super().__init__(context, node.source, child, f"while {node.text}")
        self.node, self.frame, self._limit = node, scope.frame, 0

    def foresee(self, freed: Holders) -> Status:
        limit = evaluate_rounds(self.node.limit, self.kind, self.context, self.frame)
        if not evaluate(self.node.condition, self.context.state, self.frame):
            return SUCCESS
        return FAILURE if limit == 0 else self.foresee_round(freed, is_only=False)

    def on_start(self) -> Status:
        self._limit = evaluate_rounds(self.node.limit, self.kind, self.context, self.frame)
        return super().on_start()

    def next_round(self) -> Status:
        if not evaluate(self.node.condition, self.context.state, self.frame):
            return self.succeed()
        if self.rounds < self._limit:
            return self.start_round()
        message = f"`{self.node.text}` still holds after {self._limit} rounds"
        return self.fail(Failure(kind="body", message=message, source=self.source))

    def on_child_ended(self, status: Status) -> Status:
        return RUNNING if status is SUCCESS else self.fail(self.child.failure)

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and not evaluate(self.node.condition, self.context.state, self.frame)


class ForEachNode(LoopNode):
    """Runs the child once for each item in a new frame; the assignments of the last round are kept after the loop."""

    kind: ClassVar[str] = "for"
    __slots__ = ("_items", "inner", "node", "outer")

    def __init__(
        self, context: TreeContext, node: tree.ForEach, child: Node, scope: LexicalScope, inner: Frame
    ) -> None:
        super().__init__(context, node.source, child, f"for {node.variable}")
        self.node = node
        self.outer = scope.frame
        self.inner = inner
        self._items: tuple[Value, ...] = ()

    def foresee(self, freed: Holders) -> Status:
        items = self._evaluate_items()
        if not items:
            return SUCCESS
        self._enter(items[0])
        return self.foresee_round(freed, is_only=len(items) == 1)

    def on_start(self) -> Status:
        self._items = self._evaluate_items()
        return super().on_start()

    def next_round(self) -> Status:
        if self.rounds == len(self._items):
            return self.succeed()
        self._enter(self._items[self.rounds])
        return self.start_round()

    def on_child_ended(self, status: Status) -> Status:
        if status is not SUCCESS:
            return self.fail(self.child.failure)
        if self.rounds < len(self._items):
            return RUNNING
        self.outer.update({name: value for name, value in self.inner.items() if name != self.node.variable})
        return self.succeed()

    def _evaluate_items(self) -> tuple[Value, ...]:
        items = value_of(self.node.items, self.context.state, self.outer)
        if not isinstance(items, tuple):
            raise TypeError(f"`for {self.node.variable}` needs a list, not {items!r}")
        return items

    def _enter(self, item: Value) -> None:
        """Let the child see an item, and nothing of earlier rounds."""
        self.inner.clear()
        self.inner.update(self.outer)
        self.inner[self.node.variable] = item
