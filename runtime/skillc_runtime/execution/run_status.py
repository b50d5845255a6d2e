"""How a task run is: its state, what it waits for, and what it allows."""

from __future__ import annotations

import math

from skillc_runtime.devices.prompts import Prompt
from skillc_runtime.execution.assignment import Assignment
from skillc_runtime.execution.attempt import Attempt, AttemptResult
from skillc_runtime.execution.device_claims import DeviceClaims
from skillc_runtime.execution.preparation import NextAttempt
from skillc_runtime.execution.task_state import ALLOWED, ALLOWED_AFTER_FAILURE, ANSWER
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.planning.progress import PlanningProgress
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.contact import ContactState
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.known_facts import KnownFact, unverified_facts
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.recording.states import EndState, State


class RunStatus:
    """The status of a task run.

    `attempts` are those that have ended; `failure` is why it did not succeed, `facts` what its success rests on,
    `reason` why it is in its state, `contact` what becomes of a tool that pressed when it was paused. `false_claims`
    are sentences about what the world model claimed at its end that is not so; only a simulation knows.
    """

    def __init__(
        self, run_id: str, assignment: Assignment, spec: RunSpec, claims: DeviceClaims, following: NextAttempt
    ) -> None:
        self.id, self.assignment, self.spec = run_id, assignment, spec
        self.state: State = "queued"
        self.reason = ""
        self.contact: ContactState = "none"
        self.end: EndState | None = None
        self.attempts: list[AttemptResult] = []
        self.failure: Failure | None = None
        self.facts: tuple[KnownFact, ...] = ()
        self.false_claims: tuple[str, ...] = ()
        self._claims, self._next = claims, following
        self._attempt: Attempt | None = None

    @property
    def ended(self) -> bool:
        """Whether it has ended."""
        return self.end is not None

    @property
    def needs_time(self) -> bool:
        """Whether the clock of the cell must go on for this run: not while it only plans, or waits for devices."""
        return self._attempt is not None or self.waits_for_person

    @property
    def computing(self) -> bool:
        """Whether its skills wait for what they compute beside the ticks."""
        return self._attempt is not None and self._attempt.tree.computing

    @property
    def waits_for_person(self) -> bool:
        """Whether it goes on when somebody says so: it waits for approval, or is paused."""
        return self.state in ("planned", "paused")

    @property
    def waits_for_decision(self) -> bool:
        """Whether a step failed and somebody has to decide how to go on."""
        return self.state == "paused" and self._attempt is None

    @property
    def waits(self) -> bool:
        """Whether it has a place in the queue of those that wait for planners, approval or devices."""
        return self.state in ("queued", "planning", "planned")

    @property
    def waits_for(self) -> str:
        """For what its planning waits before it begins; empty if for nothing. It is no event: it depends on others."""
        return self._next.waits_for

    @property
    def planning(self) -> PlanningProgress | None:
        """How far its planner is; None if none works. It is no event: it depends on the speed of the machine."""
        return self._next.progress

    @property
    def devices(self) -> frozenset[str] | None:
        """The devices, by IRI, that it holds; None for the whole cell."""
        return self._claims.devices_of(self.id)

    @property
    def tree(self) -> TreeRun | None:
        """The tree that runs; None between attempts."""
        return self._attempt.tree if self._attempt is not None else None

    @property
    def tree_runs(self) -> bool:
        """Whether its tree runs, which then records the changes of the world by itself."""
        return self._attempt is not None and self._attempt.tree.status is Status.RUNNING

    @property
    def allowed(self) -> tuple[str, ...]:
        """The names of the commands that are allowed now."""
        allowed = ALLOWED_AFTER_FAILURE if self.waits_for_decision else ALLOWED[self.state]
        return (*allowed, ANSWER) if self.prompts and self.state != "stopping" else allowed

    @property
    def prompts(self) -> tuple[Prompt, ...]:
        """What its skills ask operators."""
        return self._attempt.tree.active.prompts if self._attempt is not None else ()

    @property
    def stands(self) -> bool:
        """Whether it is paused or waits for approval, or all that goes on is that operators are asked."""
        return self.waits_for_person or (self._attempt is not None and self._attempt.tree.active.only_ask)

    @property
    def waits_for_facts(self) -> bool:
        """Whether nothing will happen in a cell without devices, however long it takes, but by what others write."""
        attempt = self._attempt
        return self.state == "running" and attempt is not None and attempt.ticking and math.isinf(attempt.tree.idle_s)

    @property
    def verified(self) -> bool | None:
        """Whether a success rests on no fact that is only assumed, and no claim is false; None without a success."""
        return None if self.state != "succeeded" else not unverified_facts(self.facts) and not self.false_claims
