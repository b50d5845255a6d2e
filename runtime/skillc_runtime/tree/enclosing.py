"""What the nodes of one body see of what is around them; there is no other way for a value to reach a node."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeAlias

from skillc_compiler.library.skills import Implementation
from skillc_runtime.plans.failures import Failures
from skillc_runtime.tree.undo import Undo
from skillc_runtime.world.state.values import Value

Frame: TypeAlias = dict[str, Value]


@dataclass(frozen=True, slots=True)
class Enclosing:
    """The body's surroundings, fixed while it runs.

    `frame` has the values in scope: parameters, lets, loop variables, outputs; an optional parameter that was not
    passed is absent. `implementation` is whose body this is, None in a task. `calls` are the calls around it, which
    may hold locks, outermost first; `begun` is how many writes the world had seen when the innermost of them started.
    `undo` is the innermost scope: what a scoped skill sets up is undone when it ends. `failures` are those of former
    attempts at the goal, None where the calls are no steps of a plan.
    """

    undo: Undo
    frame: Frame = field(default_factory=dict)
    implementation: Implementation | None = None
    calls: tuple[object, ...] = ()
    failures: Failures | None = None
    begun: int = 0

    @property
    def skill(self) -> str:
        """The skill whose body this is; empty in a task."""
        return self.implementation.skill if self.implementation is not None else ""

    def optional(self, name: str) -> bool:
        """Whether the name is an optional parameter around here."""
        parameters = self.implementation.parameters if self.implementation is not None else ()
        return any(parameter.name == name and parameter.direction == "opt" for parameter in parameters)
