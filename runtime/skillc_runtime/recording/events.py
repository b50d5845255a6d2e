"""Everything that can happen while a task runs, as typed values that go to listeners and to the log."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypeAlias

import msgspec

from skillc_rdf.vocabulary.types import Position
from skillc_runtime.recording.failure import Failure, Rejection
from skillc_runtime.recording.known import KnownFact
from skillc_runtime.recording.reasons import FailedCallContext, ParameterReason, UntriedImplementation
from skillc_runtime.world.state.evidence import Evidence
from skillc_runtime.world.state.labelled import LabelledChange, LabelledIri, LabelledValue

FORMAT = 4
"""Raised with every change of what the events mean. A reader takes no other format."""


class _Event(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """`time` is in seconds of the cell's clock, which in simulation is simulated time."""

    time: float


class TaskStarted(_Event, tag="task-started", frozen=True, kw_only=True):
    """A task begins; `library` and `hash` name what it runs, `format` is that of the events that follow."""

    format: int
    task: str
    library: str = ""
    hash: str = ""
    source: Position | None = None


class PlanStep(msgspec.Struct, frozen=True, kw_only=True):
    """A step of a plan: the skill and its arguments by parameter name."""

    skill: str
    arguments: dict[str, LabelledValue]
    source: Position | None = None


class PlanMade(_Event, tag="plan-made", frozen=True, kw_only=True):
    """A planner found a plan; `cost` is in the unit of durations, seconds.

    `optimal` is what the planner says about it, `quality` the same in words, which also say of what problem.
    """

    planner: str
    optimal: str
    cost: float
    steps: tuple[PlanStep, ...]
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
    attempted: FailedCallContext | None = None
    source: Position


class Highlight(msgspec.Struct, frozen=True):
    """What is worth seeing of `what` when a call begins, or ends well: that it is, say, `pressed`."""

    when: Literal["begins", "ends"]
    what: LabelledIri
    word: str


class ImplementationChosen(_Event, tag="implementation-chosen", frozen=True, kw_only=True):
    """A call starts with this implementation; `bindings` are its parameters.

    `determined` says of those that were not simply passed why they are what they are; `untried` are the implementations
    that rank after this one. `fixed` tells that the call itself names the implementation. `activity` is what a
    primitive declares that it does, as `press`; `highlights` are what there is to see of it.
    """

    node: int
    skill: str
    implementation: str
    bindings: dict[str, LabelledValue]
    rejected: tuple[Rejection, ...] = ()
    determined: tuple[ParameterReason, ...] = ()
    untried: tuple[UntriedImplementation, ...] = ()
    fixed: bool = False
    activity: str = ""
    highlights: tuple[Highlight, ...] = ()
    source: Position

    @property
    def individuals(self) -> tuple[str, ...]:
        """The IRIs of the individuals that the parameters stand for, in the order of the parameters."""
        return tuple(value.iri for value in self.bindings.values() if isinstance(value, LabelledIri))


class WorldChanged(_Event, tag="world-changed", frozen=True, kw_only=True):
    """The world model changed; `known` is how this is known, None for what others wrote."""

    origin: str
    changes: tuple[LabelledChange, ...]
    known: Evidence | None = None


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

    `verified` tells whether none of them is only assumed; None where there is no success.
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
    | Note
    | Paused
    | Resumed
    | TaskEnded
)
Listener: TypeAlias = Callable[[Event], None]
