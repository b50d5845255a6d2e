"""The lexical scope of a body: its values, its implementation and the enclosing calls."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol, TypeAlias

import msgspec

from skillc_model.skills import Implementation
from skillc_runtime.execution.tree.undo_stack import UndoStack
from skillc_runtime.recording.failure import Failure
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

Frame: TypeAlias = dict[str, Value]
"""The values in a body by name."""


class CallFailures(Protocol):
    """Remembers which calls failed, so that a call that would only fail again is skipped."""

    def add(
        self,
        skill: str,
        arguments: Mapping[str, Value],
        implementation: str,
        state: WorldState,
        failure: Failure,
        writes: int,
    ) -> None:
        """Record that an implementation failed, after so many writes, for a call that started in `state`."""
        ...

    def find_repeated(
        self, skill: str, arguments: Mapping[str, Value], implementation: str, state: WorldState
    ) -> Failure | None:
        """Return the failure that an implementation would only repeat for these arguments; None if it may be tried."""
        ...

    def forget_call(self, skill: str, arguments: Mapping[str, Value]) -> None:
        """Forget the implementations that failed for a call, because another one succeeded."""
        ...


class LexicalScope(msgspec.Struct, frozen=True):
    """The scope of a body, fixed while it runs; nodes get values only from it.

    `frame` holds the values in scope: parameters, lets, loop variables, outputs; an optional parameter that was not
    passed is absent. `implementation` is the one that the body belongs to, None in a task. `calls` are the enclosing
    calls, outermost first, which may hold locks; `writes_at_start` is the number of writes to the world before the
    innermost call started, `lets_read` the world in which its lets were computed, None in a task. `undo` is the stack
    of the innermost `with`, which is unwound when the `with` ends. `failures` are those of earlier attempts at the
    goal, None if the calls are not steps of a plan.
    """

    undo: UndoStack
    frame: Frame = msgspec.field(default_factory=dict)
    implementation: Implementation | None = None
    calls: tuple[object, ...] = ()
    failures: CallFailures | None = None
    writes_at_start: int = 0
    lets_read: WorldState | None = None

    @property
    def skill(self) -> str:
        """The name of the skill that the body belongs to; empty in a task."""
        return self.implementation.skill if self.implementation is not None else ""

    def is_optional(self, name: str) -> bool:
        """Whether `name` is an optional parameter of the enclosing implementation."""
        parameters = self.implementation.parameters if self.implementation is not None else ()
        return any(parameter.name == name and parameter.direction == "opt" for parameter in parameters)
