"""Everything that can happen while a task runs, as typed values that go to listeners and to the log."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import msgspec

from skillc_compiler.library.vocabulary import Position
from skillc_runtime.trace.failure import Failure, Rejected
from skillc_runtime.trace.known import KnownFact
from skillc_runtime.trace.reasons import Attempted, Determined, Untried
from skillc_runtime.world.state.evidence import Evidence

FORMAT = 3
"""Raised with every change of what the events mean; 2 says why parameters are what they are and what failures met, 3
how facts are known."""


class _Event(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """`time` is in seconds of the cell's clock, which in simulation is simulated time."""

    time: float


class TaskStarted(_Event, tag="task-started", frozen=True, kw_only=True):
    """A task begins; `library` and `hash` name what it runs, `format` is that of the events that follow."""

    format: int = 1
    task: str
    library: str = ""
    hash: str = ""
    source: Position | None = None


class PlanStep(msgspec.Struct, frozen=True, kw_only=True):
    """A step of a plan: the skill and its arguments by parameter name."""

    skill: str
    arguments: dict[str, str]
    source: Position | None = None


class PlanMade(_Event, tag="plan-made", frozen=True, kw_only=True):
    """A planner found a plan; `cost` is in the unit of durations, seconds.

    `optimal` is what the planner says about it, `quality` the same in words, which also say of what problem. `names`
    are the short names of the individuals in its steps, by IRI.
    """

    planner: str
    optimal: str
    cost: float
    steps: tuple[PlanStep, ...]
    names: dict[str, str] = {}
    quality: str = ""


class Replanned(_Event, tag="replanned", frozen=True, kw_only=True):
    """What was planned failed or no longer leads to the goal; the plan that follows replaces it."""

    reason: str


class NodeStarted(_Event, tag="node-started", frozen=True, kw_only=True):
    """A node of the tree starts; `parent` is the id of the node above it, 0 at the root."""

    node: int
    parent: int
    kind: str
    name: str
    source: Position


class NodeEnded(_Event, tag="node-ended", frozen=True, kw_only=True):
    """A node succeeded, failed or was halted; `failure` says why, `attempted` what a call that failed had."""

    node: int
    name: str
    status: str
    failure: Failure | None = None
    attempted: Attempted | None = None
    source: Position


class ImplementationChosen(_Event, tag="implementation-chosen", frozen=True, kw_only=True):
    """A call starts with this implementation; `bindings` are its parameters as text.

    `determined` says of those that were not simply passed why they are what they are; `untried` are the implementations
    that rank after this one. `fixed` tells that the call itself names the implementation.
    """

    node: int
    skill: str
    implementation: str
    bindings: dict[str, str]
    rejected: tuple[Rejected, ...] = ()
    determined: tuple[Determined, ...] = ()
    untried: tuple[Untried, ...] = ()
    fixed: bool = False
    source: Position


class WorldChanged(_Event, tag="world-changed", frozen=True, kw_only=True):
    """The world model changed; one line of text for each change.

    `known` is how this is known, None for what others wrote and in recordings of older formats.
    """

    origin: str
    changes: tuple[str, ...]
    known: Evidence | None = None


class Measured(_Event, tag="measured", frozen=True, kw_only=True):
    """A skill measured something; numbers in SI units."""

    name: str
    values: dict[str, float]
    node: int = 0


class Note(_Event, tag="note", frozen=True, kw_only=True):
    """Something a person may want to know, which decides nothing."""

    message: str
    node: int = 0
    source: Position | None = None


class Paused(_Event, tag="paused", frozen=True, kw_only=True):
    """The run holds still."""


class Resumed(_Event, tag="resumed", frozen=True, kw_only=True):
    """The run goes on."""


class TaskEnded(_Event, tag="task-ended", frozen=True, kw_only=True):
    """A task is over; `facts` are those that a success rests on.

    `verified` tells whether none of them is only assumed; None where there is no success, and in older formats.
    """

    task: str
    status: str
    failure: Failure | None = None
    verified: bool | None = None
    facts: tuple[KnownFact, ...] = ()


Event: TypeAlias = (
    TaskStarted
    | PlanMade
    | Replanned
    | NodeStarted
    | NodeEnded
    | ImplementationChosen
    | WorldChanged
    | Measured
    | Note
    | Paused
    | Resumed
    | TaskEnded
)
Listener: TypeAlias = Callable[[Event], None]
