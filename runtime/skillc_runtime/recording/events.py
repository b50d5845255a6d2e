"""Everything that can happen while a task runs, as typed values that go to listeners and to the log."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, TypeAlias

import msgspec

from skillc_dsl.position import Position
from skillc_model.conditions import Condition
from skillc_model.skills import TaskPart
from skillc_model.tree import Node
from skillc_runtime.devices.disturbances import Disturbance
from skillc_runtime.devices.prompts import Prompt
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.contact import ContactState
from skillc_runtime.recording.failure import Failure, Rejection
from skillc_runtime.recording.known_facts import KnownFact
from skillc_runtime.recording.reasons import (
    FailedCallContext,
    Highlight,
    ParameterReason,
    UntriedImplementation,
    WrittenExpression,
)
from skillc_runtime.recording.recorded_plan import ArrivedPlan, PlanBranch, PlanStep, StepGroup
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.recording.states import EndState, State
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.labels.labelled import LabelledChange, LabelledIri, LabelledValue

FORMAT = 12
"""Raised with every change of the events or their meaning. Readers accept this format only."""


class _Event(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """`time` is in seconds of the cell's clock, which in simulation is simulated time."""

    time: float


class TaskStarted(_Event, tag="task-started", frozen=True, kw_only=True):
    """A task starts; `library` and `hash` identify the compiled library, `format` is the format of the events.

    The objective is a `goal`, with what the plan minimises, or a `body` to run as it is; the task may take `within_s`
    of the cell's time, in s, and may break none of the conditions `always`. Several tasks that are carried out as one
    are its `parts`. `scene`, `seed` and `backend`
    are those of the cell; `scene` is empty if the world came from elsewhere, for example from a store. The run pauses
    at `breakpoints`, each SKILL or FILE:LINE, and before its first call if it is `stepped`.
    """

    format: int
    task: str
    library: str = ""
    hash: str = ""
    scene: str = ""
    seed: int = 0
    backend: str = ""
    goal: Condition | None = None
    minimise: Literal["", "work", "makespan", "cost"] = ""
    body: Node | None = None
    within_s: float | None = None
    always: tuple[Condition, ...] = ()
    parts: tuple[TaskPart, ...] = ()
    settings: RunSpec = RunSpec()
    breakpoints: tuple[str, ...] = ()
    stepped: bool = False
    source: Position | None = None


class StateChanged(_Event, tag="state-changed", frozen=True, kw_only=True):
    """The task run is in another state, and why; its end is a `TaskEnded`.

    `failure` is that of a step if somebody has to decide how to go on after it. `contact` is what becomes of a tool
    that pressed when the run was paused: if only that changes, the state is the one before.
    """

    state: State
    reason: str = ""
    failure: Failure | None = None
    contact: ContactState = "none"


class Requested(_Event, tag="requested", frozen=True, kw_only=True):
    """A command was requested and took effect in a tick of the cell's loop; `refused` is why it changed nothing."""

    command: Command
    tick: int
    refused: str = ""


class Disturbed(_Event, tag="disturbed", frozen=True, kw_only=True):
    """Something happened to the simulated cell before a tick of its loop that no skill did; `who` wanted it."""

    disturbance: Disturbance
    tick: int
    who: str = ""


class PlanArrived(_Event, tag="plan-arrived", frozen=True, kw_only=True):
    """The answer of a planner took effect in a tick of the cell's loop: a plan, or why there is none.

    Neither if there was nothing to plan and the body that was given passed its checks. `detail` is what there is to say
    besides; `proved` if there is no plan, rather than that none was found. `space` is what is known in space of a body
    that was given.
    """

    tick: int
    plan: ArrivedPlan | None = None
    refused: str = ""
    detail: str = ""
    proved: bool = False
    space: SpaceClaim | None = None


class PlanMade(_Event, tag="plan-made", frozen=True, kw_only=True):
    """A planner found a plan; `cost` is its expected duration in s.

    `optimal` is the planner's claim, `quality` the same as text, with the problem for which it holds. `arrangement`,
    `space` and `branches` are as in `ArrivedPlan`.
    """

    planner: str
    optimal: str
    cost: float
    steps: tuple[PlanStep, ...]
    quality: str = ""
    arrangement: StepGroup = StepGroup(())
    space: SpaceClaim | None = None
    branches: tuple[PlanBranch, ...] = ()

    @property
    def summary(self) -> str:
        """How long it takes and what is known of it, such as `about 60 s, proved optimal, all 4 checked in space`."""
        known = (self.quality, "" if self.space is None else self.space.summary)
        return ", ".join([f"about {self.cost:.0f} s", *filter(None, known)])


class PromptsChanged(_Event, tag="prompts-changed", frozen=True, kw_only=True):
    """Skills ask operators something else: these are all open prompts now."""

    prompts: tuple[Prompt, ...]


class Replanned(_Event, tag="replanned", frozen=True, kw_only=True):
    """The plan failed or no longer leads to the goal; the next plan replaces it.

    Or a policy goes on after what was `sensed`: the next plan is its branch, made anew if that does not work.
    """

    reason: str
    sensed: bool = False


class NodeStarted(_Event, tag="node-started", frozen=True, kw_only=True):
    """A node of the tree starts; `parent` is the id of its parent, 0 for the root."""

    node: int
    parent: int
    kind: str
    name: str
    source: Position


class NodeEnded(_Event, tag="node-ended", frozen=True, kw_only=True):
    """A node succeeded, failed or was halted; `failure` is the reason, `failed_call` the context of a failed call.

    `outputs` are the values that a call has returned, by parameter name.
    """

    node: int
    name: str
    status: str
    failure: Failure | None = None
    failed_call: FailedCallContext | None = None
    outputs: dict[str, LabelledValue] = {}
    source: Position


class ImplementationChosen(_Event, tag="implementation-chosen", frozen=True, kw_only=True):
    """A call starts with this implementation; `bindings` are its parameters.

    `determined` are the reasons for the values that were not simply passed; `untried` are the implementations that
    rank after this one. `fixed` if the call names the implementation. `activity` is what a primitive declares to do,
    for example `press`; `highlights` are the moments of it to show. `expressions` are those of the arguments and
    defaults, by parameter; `out` is the name that gets the output.
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
    expressions: dict[str, WrittenExpression] = {}
    out: str = ""
    source: Position

    @property
    def individuals(self) -> tuple[str, ...]:
        """The IRIs of the individuals that the parameters stand for, in the order of the parameters."""
        return tuple(value.iri for value in self.bindings.values() if isinstance(value, LabelledIri))


class WorldChanged(_Event, tag="world-changed", frozen=True, kw_only=True):
    """The world model changed; `known` is the evidence for the change, None for changes from outside the run."""

    origin: str
    changes: tuple[LabelledChange, ...]
    known: Evidence | None = None


class Note(_Event, tag="note", frozen=True, kw_only=True):
    """A message for users, without effect on the run."""

    message: str
    node: int = 0
    source: Position | None = None


class Paused(_Event, tag="paused", frozen=True, kw_only=True):
    """The run was paused."""


class Resumed(_Event, tag="resumed", frozen=True, kw_only=True):
    """The run was resumed."""


class TaskEnded(_Event, tag="task-ended", frozen=True, kw_only=True):
    """A task ended in the state `status`; `facts` are those that its success rests on.

    `verified` is whether none of them is only assumed, and no claim is false; None if the task did not succeed.
    `false_claims` are sentences about what the world model claims of things that is not so in the simulator.
    """

    task: str
    status: EndState
    failure: Failure | None = None
    verified: bool | None = None
    facts: tuple[KnownFact, ...] = ()
    false_claims: tuple[str, ...] = ()


Event: TypeAlias = (
    TaskStarted
    | StateChanged
    | Requested
    | Disturbed
    | PlanArrived
    | PlanMade
    | PromptsChanged
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
