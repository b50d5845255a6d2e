"""Operations of a cell as data: what is requested, and how far it is."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, TypeAlias

import msgspec

from skillc_runtime.devices.prompts import Prompt
from skillc_runtime.planning.progress import PlanningProgress
from skillc_runtime.recording.contact import ContactState as ContactState
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.history.account import CallOutput, MeasuredProperty
from skillc_runtime.recording.run_spec import RunRequest
from skillc_runtime.recording.states import ENDS as ENDS
from skillc_runtime.recording.states import Decision as Decision
from skillc_runtime.recording.states import State as State

MAX_REASON = 500
OperationId: TypeAlias = Annotated[str, msgspec.Meta(max_length=200)]


class OperationRequest(RunRequest, frozen=True, kw_only=True):
    """What is to be done in a cell, with its library, and how; `owner` is who requested it.

    A request that `continues` an operation that was interrupted names nothing else to do; `decision` says how, and
    `why` a step counts as done that is skipped.
    """

    owner: str = ""
    continues: str = ""
    decision: Decision = "replan"
    why: Annotated[str, msgspec.Meta(max_length=500)] = ""


class OperationStatus(msgspec.Struct, frozen=True, kw_only=True):
    """An operation as it is now: `reason` says why it is in its state, or for what it waits.

    `contact` is what becomes of a tool that pressed when it was paused: it presses on, it is being taken off, it was
    taken off, or it approaches until it senses contact.
    `allowed` are the names of the commands that it allows. `events` is the number of its last event. `verified` is
    whether a success rests on no fact that is only assumed, and no claim is false; None if it did not succeed.
    It was submitted, its first attempt began, and it ended at `submitted_at`, `started_at` and `ended_at`, null before.
    `failure` is why it did not succeed, or why the step failed after which somebody has to decide how it goes on.
    `outputs` are what its outermost calls have returned, `measures` the properties that it has measured, so far; of
    each the last hundred.
    `false_claims` are sentences about what the world model claimed at its end that is not so in the simulator.
    `library_hash` identifies what it runs. `devices` are the IRIs of those that it holds, null for the whole cell.
    `prompts` are what its skills ask operators. `planning` is how far its planner is; null if none works. `breakpoints`
    are those at which it pauses now. `decisions` are how it can be continued if it was interrupted, `continued_by` is
    the operation that does. `place` is its place among those of its cell that wait, from 1; 0 if it does not wait.
    """

    id: str
    cell: str
    request: OperationRequest
    state: State
    reason: str = ""
    contact: ContactState = "none"
    allowed: tuple[str, ...] = ()
    events: int = 0
    verified: bool | None = None
    false_claims: tuple[str, ...] = ()
    submitted_at: datetime | None = None
    started_at: datetime | None = None
    ended_at: datetime | None = None
    failure: Failure | None = None
    outputs: tuple[CallOutput, ...] = ()
    measures: tuple[MeasuredProperty, ...] = ()
    library_hash: str = ""
    devices: tuple[str, ...] | None = ()
    prompts: tuple[Prompt, ...] = ()
    planning: PlanningProgress | None = None
    breakpoints: tuple[str, ...] = ()
    decisions: tuple[Decision, ...] = ()
    continued_by: str = ""
    place: int = 0

    @property
    def is_sound(self) -> bool:
        """Whether it succeeded, and the simulator contradicts nothing that the world model claimed at its end."""
        return self.state == "succeeded" and not self.false_claims


class StopReason(msgspec.Struct, frozen=True):
    """Why an operation, or everything, is stopped. A long reason is cut, and what else a body has is ignored."""

    reason: str = "stopped"

    @property
    def shown(self) -> str:
        """The reason as it is recorded."""
        return self.reason if len(self.reason) <= MAX_REASON else f"{self.reason[:MAX_REASON]} .."


class QueueOrder(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The ids of the operations that come first among those that wait in a cell, in this order."""

    first: Annotated[tuple[OperationId, ...], msgspec.Meta(min_length=1, max_length=200)]
