"""How a call waits for what others use, before it has started."""

from __future__ import annotations

import math

from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.locks import LockingCall, describe_circle, describe_waits
from skillc_runtime.recording.failure import Failure


class Turn:
    """The turn of a call at what it uses: it waits for one of its `choices`, and keeps its place until it has begun."""

    __slots__ = ("_call", "_context", "_enclosing", "_late", "choices", "pending")

    def __init__(self, context: TreeContext, call: LockingCall, enclosing: tuple[object, ...]) -> None:
        self._context, self._call, self._enclosing = context, call, enclosing
        self.choices: list[list[str]] = []
        self.pending, self._late = False, math.inf

    @property
    def is_late(self) -> bool:
        """Whether the call has waited until the deadline of each step."""
        return self._context.now >= self._late

    @property
    def has_come(self) -> bool:
        """Whether one of the choices is free, and nobody comes before."""
        return self._context.locks.is_free(self._call)

    def must_wait(self, individuals: list[str]) -> bool:
        """Whether others use one of these individuals, or wait for it and came first."""
        return self._context.locks.find_conflict(individuals, self._call, self._enclosing) is not None

    def wait(self) -> Failure | None:
        """Begin to wait, or go on to; return the failure if others wait for what encloses the call."""
        context, locks, call = self._context, self._context.locks, self._call
        short = context.library.vocabulary.short
        circle = locks.wait(call, self.choices, self._enclosing)
        if circle:
            message = describe_circle(circle, short, locks.run)
            return Failure(kind="lock", message=message, source=call.source, skill=call.skill_name)
        if not self.pending:
            self.pending, self._late = True, context.find_step_end()
            context.note(describe_waits(locks.find_conflicts(call), short, locks.run), call.id, call.source)
        return None
