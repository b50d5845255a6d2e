"""A call before it starts: held back where its run pauses, and waiting for what others use."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar

from skillc_model import tree
from skillc_model.skills import PausePolicy
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.lexical_scope import LexicalScope
from skillc_runtime.execution.tree.locks import describe_circle, describe_waits
from skillc_runtime.execution.tree.node import RUNNING, Node
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS


class WaitingCall(Node):
    """A call that waits until it may start, and then begins; a subclass implements `begin`.

    `choices` are the individuals of which it needs all of one choice. It keeps its place until it has begun.
    """

    kind: ClassVar[str] = "call"
    __slots__ = ("_held_back", "_late", "choices", "is_queued", "node", "scope", "skill")

    def __init__(self, context: TreeContext, node: tree.Call, scope: LexicalScope) -> None:
        super().__init__(context, node.source, name=node.skill)
        self.node, self.scope = node, scope
        self.skill = context.library.skills[node.skill]
        self.choices: list[list[str]] = []
        self.is_queued, self._late = False, math.inf
        self._held_back = False

    @property
    def skill_name(self) -> str:
        """The name of the skill."""
        return self.skill.name

    @property
    def pause_policy(self) -> PausePolicy:
        """Where the skill may be paused."""
        return self.skill.pause

    @property
    def waits(self) -> bool:
        """Whether it is held back or waits for what others use, and has not started."""
        return self._held_back or self.is_queued

    def enclosing_calls(self) -> Iterator[WaitingCall]:
        """Yield the calls around this one, the innermost first."""
        node = self.parent
        while node is not None:
            if isinstance(node, WaitingCall):
                yield node
            node = node.parent

    def begin(self) -> Status:
        """Start, or wait for what others use."""
        raise NotImplementedError

    def on_start(self) -> Status:
        gate = self.context.gate
        self._held_back, self.is_queued = gate is not None and gate.stops(self), False
        return RUNNING if self._held_back else self.begin()

    def tick(self) -> Status:
        """Begin as soon as the gate, and those who use what is needed, allow it."""
        context, gate = self.context, self.context.gate
        if self._held_back and gate is not None and gate.holds_back(self):
            return RUNNING
        if self.is_queued and not context.locks.is_free(self):
            return RUNNING if context.now < self._late else self.fail_late()
        self._held_back = self.is_queued and gate is not None and gate.reason is not None and gate.stops(self)
        if self._held_back:
            return RUNNING
        try:
            return self.begin()
        except FOREIGN_ERRORS as error:  # a node is the boundary: it reports, halts and fails
            return self.fail_with_error(error)

    def stop(self, reason: str) -> None:
        super().stop(reason)
        self.context.locks.release(self)

    def must_wait_for(self, individuals: list[str]) -> bool:
        """Whether others use one of these individuals, or wait for it and came first."""
        return self.context.locks.find_conflict(individuals, self, self.scope.calls) is not None

    def queue_up(self) -> Status:
        """Begin to wait for one of the choices, or go on to; fail if others wait for what encloses this call."""
        context, locks, short = self.context, self.context.locks, self.context.library.vocabulary.short
        circle = locks.wait(self, self.choices, self.scope.calls)
        if circle:
            message = describe_circle(circle, short, locks.run)
            return self.fail_unstarted(Failure(kind="lock", message=message, source=self.source, skill=self.skill.name))
        if not self.is_queued:
            self.is_queued, self._late = True, context.find_step_end()
            context.note(describe_waits(locks.find_conflicts(self), short, locks.run), self.id, self.source)
        return RUNNING

    def fail_unstarted(self, failure: Failure) -> Status:
        """Fail without having started; nobody has to wait behind this call any more."""
        self.context.locks.release(self)
        return self.fail(failure)
