"""Nodes that change the result of their only child or limit its time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import ClassVar

from skillc_model import tree
from skillc_runtime.execution.tree.active_path import ActivePath
from skillc_runtime.execution.tree.context import EPSILON_S, TreeContext
from skillc_runtime.execution.tree.lexical_scope import LexicalScope
from skillc_runtime.execution.tree.locks import Holders
from skillc_runtime.execution.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.execution.tree.nodes.leaf_nodes import evaluate_seconds
from skillc_runtime.execution.tree.nodes.loop_nodes import RepeatNode, RetryNode
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.primitives.time_limits import describe_slowness
from skillc_runtime.recording.failure import Failure

_INVERTED = {SUCCESS: FAILURE, FAILURE: SUCCESS}


class DecoratorNode(Node):
    """A node whose result follows from that of its child; a row of `skillc_dsl.descriptions.nodes` describes it."""

    __slots__ = ("child",)

    def __init__(self, context: TreeContext, node: tree.Decorator, child: Node, scope: LexicalScope) -> None:
        super().__init__(context, node.source, (child,))
        self.child = child

    def on_start(self) -> Status:
        return self.on_child_ended(self.child.start())

    def active_leaf(self) -> Node:
        return self.child.active_leaf()


class TimeoutNode(Node):
    """Halts the child and fails in the first tick after the given time; a child that ends just then is in time."""

    kind: ClassVar[str] = "timeout"
    __slots__ = ("_deadline", "_path", "child", "frame", "node")

    def __init__(self, context: TreeContext, node: tree.Timeout, child: Node, scope: LexicalScope) -> None:
        super().__init__(context, node.source, (child,))
        self.node = node
        self.child = child
        self.frame = scope.frame

    def foresee(self, freed: Holders) -> Status:
        return self.child.dry_start(freed)

    def on_start(self) -> Status:
        seconds = evaluate_seconds(self.node.seconds, self.context, self.frame)
        self.name = f"timeout {seconds:g} s"
        self._deadline = self.context.now + seconds + EPSILON_S
        self.context.expect(self.context.now + seconds)
        self.context.expect(self._deadline + EPSILON_S)
        self._path = ActivePath(self.child)
        return self.on_child_ended(self._path.start())

    def tick(self) -> Status:
        if self.context.now > self._deadline:
            late = f"{self.child.name} was not done after {self.name.removeprefix('timeout ')}"
            message = f"{late}{describe_slowness(self.context.spec.speed)}"
            self.stop(message)
            return self.fail(Failure(kind="timeout", message=message, source=self.source))
        status = self._path.tick()
        return RUNNING if status is RUNNING else self.on_child_ended(status)

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and self.child.remains_satisfied()

    def on_child_ended(self, status: Status) -> Status:
        if status is RUNNING:
            return RUNNING
        return self.succeed() if status is SUCCESS else self.fail(self.child.failure)


class TryNode(DecoratorNode):
    """Turns a failure of the child into success, except a violated hold."""

    kind: ClassVar[str] = "try"
    __slots__ = ()

    def foresee(self, freed: Holders) -> Status:
        status = self.child.dry_start(freed)
        return SUCCESS if status is FAILURE else status  # whether it breaks a hold, only its start tells

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and (self.child.status is FAILURE or self.child.remains_satisfied())

    def on_child_ended(self, status: Status) -> Status:
        if status is RUNNING:
            return RUNNING
        failure = self.child.failure
        if failure is not None and failure.breaks_hold:
            return self.fail(failure)
        return self.succeed()


class InvertNode(DecoratorNode):
    """Exchanges success and failure, except a violated hold."""

    kind: ClassVar[str] = "invert"
    __slots__ = ()

    def foresee(self, freed: Holders) -> Status:
        status = self.child.dry_start(freed)
        return _INVERTED.get(status, status)

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and self.child.would_fail_again()

    def on_child_ended(self, status: Status) -> Status:
        if status is RUNNING:
            return RUNNING
        if status is SUCCESS:
            message = f"{self.child.name} succeeded, which `invert` makes a failure"
            return self.fail(Failure(kind="body", message=message, source=self.source))
        failure = self.child.failure
        return self.fail(failure) if failure is not None and failure.breaks_hold else self.succeed()


class OnceNode(DecoratorNode):
    """Runs the child to its end at most once per activation of the enclosing skill, then keeps returning its result.

    A child that was halted has no result and runs again.
    """

    kind: ClassVar[str] = "once"
    __slots__ = ()

    def foresee(self, freed: Holders) -> Status:
        return self.child.status if self._has_result else self.child.dry_start(freed)

    def on_start(self) -> Status:
        return self.on_child_ended(self.child.status if self._has_result else self.child.start())

    @property
    def _has_result(self) -> bool:
        return self.child.status in (SUCCESS, FAILURE)

    def on_child_ended(self, status: Status) -> Status:
        if status is RUNNING:
            return RUNNING
        return self.succeed() if status is SUCCESS else self.fail(self.child.failure)


DECORATORS: Mapping[type[tree.Decorator], Callable[..., Node]] = {
    tree.Retry: RetryNode,
    tree.Repeat: RepeatNode,
    tree.Timeout: TimeoutNode,
    tree.Try: TryNode,
    tree.Invert: InvertNode,
    tree.Once: OnceNode,
}
"""What runs each decorator; made with the context, the compiled node, the child and the scope."""
