"""Nodes without children: waiting, checking, and writing posts."""

from __future__ import annotations

import math
from typing import ClassVar

from skillc_compiler.library import tree
from skillc_compiler.library.conditions import Expression
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.trace.failure import Failure
from skillc_runtime.tree.context import Context
from skillc_runtime.tree.enclosing import Enclosing, Frame
from skillc_runtime.tree.node import RUNNING, Node
from skillc_runtime.tree.sensing import unsensed
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.effects import changes_of
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.expressions import value_of

_EPSILON_S = 1e-9


def seconds_of(expression: Expression, context: Context, frame: Frame) -> float:
    """Evaluate a time in seconds; ValueError for one that is no finite number."""
    seconds = value_of(expression, context.state, frame)
    if not isinstance(seconds, int | float) or not math.isfinite(seconds):
        raise ValueError(f"a time must be a finite number of seconds, not {seconds!r}")
    return float(seconds)


class WaitNode(Node):
    """Succeeds after a time."""

    kind: ClassVar[str] = "wait"
    __slots__ = ("_until", "frame", "node")

    def __init__(self, context: Context, node: tree.Wait, enclosing: Enclosing) -> None:
        super().__init__(context, node.source)
        self.node = node
        self.frame = enclosing.frame

    def begin(self) -> Status:
        self._until = self.context.now + seconds_of(self.node.seconds, self.context, self.frame) - _EPSILON_S
        return self.tick()

    def tick(self) -> Status:
        return RUNNING if self.context.now < self._until else self.end()


class WaitUntilNode(Node):
    """Succeeds when the condition holds, which is evaluated anew only in a new state of the world."""

    kind: ClassVar[str] = "wait until"
    __slots__ = ("_seen", "frame", "node")

    def __init__(self, context: Context, node: tree.WaitUntil, enclosing: Enclosing) -> None:
        super().__init__(context, node.source, name=f"wait until {node.text}")
        self.node = node
        self.frame = enclosing.frame

    def begin(self) -> Status:
        self._seen: object = None
        return self.tick()

    def tick(self) -> Status:
        state = self.context.state
        if state is self._seen:
            return RUNNING
        self._seen = state
        try:
            return self.end() if evaluate(self.node.condition, state, self.frame) else RUNNING
        except Exception as error:  # noqa: BLE001  a node is the boundary: it reports and fails
            return self.broken(error)

    def still(self) -> bool:
        return evaluate(self.node.condition, self.context.state, self.frame)


class CheckNode(Node):
    """Succeeds when the condition holds, else fails with what holds instead."""

    kind: ClassVar[str] = "check"
    __slots__ = ("frame", "node")

    def __init__(self, context: Context, node: tree.Check, enclosing: Enclosing) -> None:
        super().__init__(context, node.source, name=f"check {node.text}")
        self.node = node
        self.frame = enclosing.frame

    def begin(self) -> Status:
        state = self.context.state
        if evaluate(self.node.condition, state, self.frame):
            return self.end()
        instead = explain(self.node.condition, state, self.frame, self.context.library.vocabulary)
        message = f"`{self.node.text}` does not hold: {instead}"
        return self.fail(Failure(kind="body", message=message, source=self.source))

    def still(self) -> bool:
        return evaluate(self.node.condition, self.context.state, self.frame)

    def fails_still(self) -> bool:
        return not self.still()


class ApplyNode(Node):
    """Writes posts of the enclosing skill into the world model, but for what was sensed since that skill started."""

    kind: ClassVar[str] = "apply"
    __slots__ = ("enclosing", "posts")

    def __init__(self, context: Context, node: tree.Apply, enclosing: Enclosing) -> None:
        super().__init__(context, node.source, name=f"apply {', '.join(node.labels)}")
        posts = enclosing.implementation.post if enclosing.implementation is not None else ()
        self.posts = tuple(post for post in posts if post.label in node.labels)
        self.enclosing = enclosing

    def begin(self) -> Status:
        effects = tuple(effect for post in self.posts for effect in post.effects)
        changes = changes_of(effects, self.context.state, self.enclosing.frame)
        assumed = unsensed(changes, self.context.cell.world, self.enclosing.begun)
        if assumed:
            self.context.assume(assumed, f"{self.enclosing.skill}: {self.name}")
        return self.end()

    def still(self) -> bool:
        state, frame = self.context.state, self.enclosing.frame
        return all(evaluate(post.condition, state, frame) for post in self.posts)
