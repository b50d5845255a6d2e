"""Nodes without children: waiting, checking conditions, and writing posts."""

from __future__ import annotations

import math
from typing import ClassVar

from skillc_model import tree
from skillc_model.conditions import Expression, Message
from skillc_runtime.execution.tree.context import EPSILON_S, TreeContext
from skillc_runtime.execution.tree.lexical_scope import Frame, LexicalScope
from skillc_runtime.execution.tree.locks import Holders
from skillc_runtime.execution.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.execution.tree.sensing import drop_sensed_changes
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.effects import changes_of
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.eval.messages import label_values
from skillc_runtime.world.state.labels.labelled import LabelledValue
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS


def evaluate_seconds(expression: Expression, context: TreeContext, frame: Frame) -> float:
    """Evaluate a duration in s. Raises ValueError if it is not finite."""
    seconds = value_of(expression, context.state, frame)
    if not isinstance(seconds, int | float) or not math.isfinite(seconds):
        raise ValueError(f"a time must be a finite number of seconds, not {seconds!r}")
    return float(seconds)


class WaitNode(Node):
    """Succeeds after a time."""

    kind: ClassVar[str] = "wait"
    __slots__ = ("_late", "_until", "frame", "node")

    def __init__(self, context: TreeContext, node: tree.Wait, scope: LexicalScope) -> None:
        super().__init__(context, node.source)
        self.node = node
        self.frame = scope.frame

    def foresee(self, freed: Holders) -> Status:
        return RUNNING if evaluate_seconds(self.node.seconds, self.context, self.frame) > EPSILON_S else SUCCESS

    def on_start(self) -> Status:
        self._late = self.context.find_step_end()
        until = self.context.now + evaluate_seconds(self.node.seconds, self.context, self.frame)
        self._until = until - EPSILON_S
        self.context.expect(until)
        return self.tick()

    def tick(self) -> Status:
        now = self.context.now
        if now >= self._until:
            return self.succeed()
        return RUNNING if now < self._late else self.fail_late()


class WaitUntilNode(Node):
    """Succeeds once the condition is true; it is evaluated only when the state of the world is new."""

    kind: ClassVar[str] = "wait until"
    __slots__ = ("_late", "_seen", "frame", "node")

    def __init__(self, context: TreeContext, node: tree.WaitUntil, scope: LexicalScope) -> None:
        super().__init__(context, node.source, name=f"wait until {node.text}")
        self.node = node
        self.frame = scope.frame

    def foresee(self, freed: Holders) -> Status:
        return SUCCESS if self.remains_satisfied() else RUNNING

    def on_start(self) -> Status:
        self._seen: object = None
        self._late = self.context.find_step_end()
        return self.tick()

    def tick(self) -> Status:
        state = self.context.state
        try:
            if state is not self._seen and evaluate(self.node.condition, state, self.frame):
                return self.succeed()
        except FOREIGN_ERRORS as error:  # a node is the boundary: it reports and fails
            return self.fail_with_error(error)
        self._seen = state
        return RUNNING if self.context.now < self._late else self.fail_late()

    def remains_satisfied(self) -> bool:
        return evaluate(self.node.condition, self.context.state, self.frame)


class CheckNode(Node):
    """Succeeds if the condition is true, else fails with the facts that make it false."""

    kind: ClassVar[str] = "check"
    __slots__ = ("frame", "node")

    def __init__(self, context: TreeContext, node: tree.Check, scope: LexicalScope) -> None:
        super().__init__(context, node.source, name=f"check {node.text}")
        self.node = node
        self.frame = scope.frame

    def foresee(self, freed: Holders) -> Status:
        return SUCCESS if self.remains_satisfied() else FAILURE

    def on_start(self) -> Status:
        state = self.context.state
        if evaluate(self.node.condition, state, self.frame):
            return self.succeed()
        instead = explain(self.node.condition, state, self.frame, self.context.library.vocabulary)
        message = f"`{self.node.text}` does not hold: {instead}"
        return self.fail(Failure(kind="body", message=message, source=self.source))

    def remains_satisfied(self) -> bool:
        return evaluate(self.node.condition, self.context.state, self.frame)

    def would_fail_again(self) -> bool:
        return not self.remains_satisfied()


class FailNode(Node):
    """Fails for a reason with values in it, which are recorded beside it."""

    kind: ClassVar[str] = "fail"
    __slots__ = ("frame", "node")

    def __init__(self, context: TreeContext, node: tree.Fail, scope: LexicalScope) -> None:
        super().__init__(context, node.source)
        self.node = node
        self.frame = scope.frame

    def foresee(self, freed: Holders) -> Status:
        return FAILURE

    def on_start(self) -> Status:
        state, vocabulary = self.context.state, self.context.library.vocabulary
        reason, values = self.node.reason, dict[str, LabelledValue]()
        if isinstance(reason, Message):
            read = {each.name: value_of(each.value, state, self.frame) for each in reason.values}
            values = label_values(reason, read, vocabulary)
        message = str(value_of(reason, state, self.frame))
        return self.fail(Failure(kind="body", message=message, source=self.source, values=values))

    def would_fail_again(self) -> bool:
        return True


class ApplyNode(Node):
    """Writes posts of the enclosing skill to the world model, except for facts sensed since that skill started."""

    kind: ClassVar[str] = "apply"
    __slots__ = ("posts", "scope")

    def __init__(self, context: TreeContext, node: tree.Apply, scope: LexicalScope) -> None:
        super().__init__(context, node.source, name=f"apply {', '.join(node.labels)}")
        posts = scope.implementation.post if scope.implementation is not None else ()
        self.posts = tuple(post for post in posts if post.label in node.labels)
        self.scope = scope

    def on_start(self) -> Status:
        effects = tuple(effect for post in self.posts for effect in post.effects)
        changes = changes_of(effects, self.context.state, self.scope.frame)
        assumed = drop_sensed_changes(changes, self.context.cell.world, self.scope.writes_at_start)
        if assumed:
            self.context.write_assumed(assumed, f"{self.scope.skill}: {self.name}")
        return self.succeed()

    def remains_satisfied(self) -> bool:
        state, frame = self.context.state, self.scope.frame
        return all(evaluate(post.achieved, state, frame) for post in self.posts)
