"""A task run: the state machine that prepares, attempts, pauses and replans a task. The loop of its cell ticks it."""

from __future__ import annotations

from contextlib import nullcontext
from typing import Literal

from msgspec.structs import replace

from skillc_runtime.execution.assignment import Assignment, NotStarted, PreparedTask
from skillc_runtime.execution.attempt import Attempt, AttemptResult, RunContext
from skillc_runtime.execution.conclusion import (
    MAX_ATTEMPTS,
    Ended,
    NeedsPlan,
    collect_facts,
    conclude,
    find_sensed,
    no_other_plan,
)
from skillc_runtime.execution.decisions import try_command
from skillc_runtime.execution.device_claims import DeviceClaims, DevicesBusy
from skillc_runtime.execution.limits import AlwaysWatch, TimeLimit
from skillc_runtime.execution.pausing import PauseControl
from skillc_runtime.execution.preparation import NextAttempt, Outdated, StartPreparation
from skillc_runtime.execution.run_events import make_arrival_event, make_plan_event, make_start_event
from skillc_runtime.execution.run_status import RunStatus
from skillc_runtime.execution.success_facts import collect_forces
from skillc_runtime.execution.task_state import Ending, RefusedCommand, refusal
from skillc_runtime.execution.tree.gate import format_breakpoints, read_breakpoint
from skillc_runtime.execution.world_edit import recorded_changes, write_choices
from skillc_runtime.planning.validation import PlanError
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording import commands
from skillc_runtime.recording.contact import ContactState
from skillc_runtime.recording.events import Event, Replanned, Requested, StateChanged, TaskEnded
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.failure_text import describe_failure
from skillc_runtime.recording.states import EndState, State
from skillc_runtime.world.state.transactions import StoreError

DECISION_LIMIT_S = 86_400.0
"""How long a run waits for a person, in s of the cell: for approval, for a decision after a failure, while paused."""


class TaskRun(RunStatus):
    """One execution of a task, from its submission to its end; `id` names it in its cell.

    It has no loop: `tick` is called once a tick of the cell, and never waits.
    """

    def __init__(
        self,
        run_id: str,
        assignment: Assignment,
        context: RunContext,
        claims: DeviceClaims,
        start_preparation: StartPreparation,
    ) -> None:
        """Submit a task; nothing starts before the first tick. A deadline comes before the time of the task."""
        if context.spec.deadline_s is not None:
            assignment = assignment.without_times()
        super().__init__(run_id, assignment, context.spec, claims, NextAttempt(start_preparation))
        self._context = context
        self._state_since = now = context.backend.clock.now
        self._limit = TimeLimit(assignment.within_s, now, assignment.parts)
        self._always = AlwaysWatch(assignment.always, context.backend.cell.world)
        self._pause = PauseControl(context.gate, context.backend.clock)
        self._ending: Ending | None = None
        self._writes_before = context.backend.cell.world.ledger.count
        self._emit(make_start_event(assignment, context.library, context.origin, self._now, context.spec, context.gate))

    @property
    def breakpoints(self) -> tuple[str, ...]:
        """At which calls it pauses, each SKILL or FILE:LINE."""
        return format_breakpoints(self._context.gate.breakpoints)

    def request(self, command: commands.Command, tick: int) -> RefusedCommand | None:
        """Do what is requested in a tick of the loop; return why not if it is refused, and nothing has changed."""
        if self.ended:
            return refusal(command, self.state, ())
        refused = refusal(command, self.state, self.allowed) or self._try(command)
        self._emit(Requested(time=self._now, command=command, tick=tick, refused=str(refused or "")))
        if refused is None:
            self._obey(command)
            self._settle_state()
        return refused

    def tick(self, tick: int) -> bool:
        """Do the work of one tick of the loop, whose number is `tick`; return whether anything happened."""
        before = self.state
        if self._ending is None:
            self._check_limits()
        if self.state == "queued":
            self._begin() if self._next.prepared is not None else self._prepare()
        arrived = self.state == "planning" and self._take_preparation(tick)
        if self._attempt is not None:
            self._tick_attempt(self._attempt)
        return arrived or self._attempt is not None or self.state != before

    def find_idle_s(self) -> float:
        """Return for how long, in s, nothing will happen by itself in a cell without devices; 0 if that is not known.

        Infinite if it waits for no time.
        """
        if self.state != "running" or self._attempt is None or not self._attempt.ticking:
            return 0.0
        return min(self._attempt.tree.idle_s, self._limit.left_s(self.spec, self._now))

    def abort(self, error: BaseException) -> None:
        """Fail because of an error of the cell."""
        if self._attempt is not None:
            self._attempt.tree.abort(error)

    def end_as(self, state: Literal["failed", "interrupted"], reason: str) -> None:
        """Halt everything because of something outside of the run; it ends in `state` when its devices are at rest."""
        self._stop(state, Failure(kind="error" if state == "failed" else "interrupted", message=reason))

    def wait(self, seconds: float) -> None:
        """Wait for up to `seconds` of wall time for what is planned, or computed by skills, if nothing else goes on."""
        if self.computing and self.tree is not None:
            self.tree.wait(seconds)
        else:
            self._next.wait(seconds)

    @property
    def _now(self) -> float:
        return self._context.backend.clock.now

    def _obey(self, command: commands.Command) -> None:
        """Do what an allowed command says, after `_try`."""
        match command:
            case commands.Stop(reason=reason, at_once=at_once):
                self._stop("stopped", Failure(kind="halted", message=reason))
                if at_once and self._attempt is not None:
                    self._attempt.end_at_once(self._claims.devices_of(self.id))
                    self._end_attempt(self._attempt)
            case commands.Abort(reason=reason):
                self.end_as("failed", reason)
            case commands.Approve() | commands.RetryStep() | commands.Skip():
                self._enter("queued", command.name)
            case commands.Replan():
                self._context.gate.open()
                if self._attempt is not None:
                    self._attempt.invalidate("another plan was requested")
                else:
                    self._prepare()
            case commands.SetBreakpoints(breakpoints=breakpoints):
                self._context.gate.breakpoints = frozenset(map(read_breakpoint, breakpoints))
            case commands.EditWorld() | commands.AnswerPrompt():
                pass
            case _:
                assert self._attempt is not None, "a pause concerns what runs"
                tree = self._attempt.tree
                self._pause.obey(command, tree)
                if tree.awaits_result:  # its next tick comes with the result
                    self._pause.follow(tree)

    def _try(self, command: commands.Command) -> RefusedCommand | None:
        """Do the part of a command that may turn out to be impossible; return why, and then nothing has changed."""
        world = self._context.backend.cell.world
        try:
            with nullcontext() if self.tree_runs else recorded_changes(world, self._emit, self._now):
                prepared = try_command(command, self.assignment, self.attempts, self._context, self.tree)
        except (PlanError, StoreError, ValueError) as error:  # refused by the plan, by the store, or by the world model
            return RefusedCommand(command.name, self.state, self.allowed, str(error))
        self._next.prepared = prepared or self._next.prepared
        return None

    def _prepare(self) -> None:
        """Start to plan for the world as it is now."""
        self._enter("planning", self.attempts[-1].reason if self.attempts else "")
        state = self._context.backend.cell.world.snapshot()
        sensed = find_sensed(self.attempts[-1], self._context.library, state) if self.attempts else None
        assignment = replace(self.assignment, state=state, sensed=sensed)
        self._next.plan(assignment, self._context.failures)

    def _take_preparation(self, tick: int) -> bool:
        """Take the answer of the preparation if it has arrived."""
        answer = self._next.take()
        if answer is None:
            return False
        self._emit(make_arrival_event(answer, self._context.library, self._now, tick))
        if isinstance(answer, NotStarted):
            self._finish("failed", no_other_plan(self.attempts, self._context.failures, answer))
        elif self.spec.approve:
            self._enter("planned", "waits for approval")
        else:
            self._begin()
        return True

    def _begin(self) -> None:
        """Begin an attempt if the plan still works and its devices are free; else plan again, or wait."""
        state = self._context.backend.cell.world.snapshot()
        match self._next.begin(self.id, self._claims, self._context.library, state):
            case PreparedTask() as prepared:
                self._start_attempt(prepared)
            case DevicesBusy() as busy:
                self._enter("queued", busy.describe(self._context.library.vocabulary))
            case Outdated(problem, times) if times == MAX_ATTEMPTS:
                message = f"the world changed {times} times so that a plan no longer worked: {problem}"
                self._finish("failed", Failure(kind="plan", message=message))
            case Outdated():
                self._prepare()

    def _start_attempt(self, prepared: PreparedTask) -> None:
        context, last = self._context, self.attempts[-1] if self.attempts else None
        if last is not None:
            sensed = prepared.assignment.sensed
            why = last.reason if sensed is None else sensed.why
            self._emit(Replanned(time=self._now, reason=why, sensed=sensed is not None))
        if (event := make_plan_event(prepared, context.library, self._now)) is not None:
            self._emit(event)
            if event.space is not None and event.space.stopped:
                context.emit_notes([f"the plan is {event.space.summary}"])
        if event is not None and event.space is not None:
            state = write_choices(context.backend.cell.world, event.space, self._emit, self._now)
            prepared = replace(prepared, assignment=replace(prepared.assignment, state=state))
        self._always.begin()
        context.gate.forget_waiting()
        self._pause = PauseControl(context.gate, context.backend.clock)
        self._attempt = Attempt(prepared, context, last.last_node if last else 0)
        self._enter("running")

    def _tick_attempt(self, attempt: Attempt) -> None:
        attempt.tick(self._claims.devices_of(self.id))
        self._check_always()
        if attempt.ticking:
            self._pause.follow(attempt.tree)
            self._settle_state()
        elif attempt.ended:
            self._end_attempt(attempt)

    def _end_attempt(self, attempt: Attempt) -> None:
        self._attempt = None
        self.attempts.append(attempt.result())
        self._conclude(self.attempts[-1])

    def _conclude(self, last: AttemptResult) -> None:
        """Decide how to go on after an attempt."""
        if self._ending is not None:
            return self._finish(self._ending.state, self._ending.failure)
        backend = self._context.backend
        conclusion = conclude(self.attempts, self._context.failures, backend.cell.world)
        if self.spec.ask_after_failure and last.status is Status.FAILURE and backend.broken is None:
            self._context.gate.open()
            return self._enter("paused", last.reason, last.failure)
        match conclusion:
            case NeedsPlan():
                return self._prepare() if backend.broken is None else self._finish("failed", last.failure)
            case Ended(state, failure):
                return self._finish(state, failure)

    def _check_limits(self) -> None:
        """Fail if the time is up, nobody has decided, or the cell is broken before an attempt has begun."""
        self._check_always()
        world, broken = self._context.backend.cell.world, self._context.backend.broken
        late = self._limit.describe_excess(self.spec, self._now, world)
        if late is not None:
            self._stop("failed", Failure(kind="timeout", message=late))
        elif self.waits_for_person and self._now - self._state_since >= DECISION_LIMIT_S:
            why = f"nobody has decided for {DECISION_LIMIT_S:g} s how it goes on"
            self._stop("failed", Failure(kind="timeout", message=why))
        elif broken is not None and self._attempt is None:
            self.end_as("failed", broken)

    def _check_always(self) -> None:
        """Fail if what is to hold always does not."""
        if self._always.broken is not None:
            by = self._always.by if self._always.by in self._context.library.skills else ""
            self._stop("failed", Failure(kind="always", message=self._always.broken, skill=by))

    def _stop(self, state: EndState, failure: Failure) -> None:
        """Halt everything; the run ends when its devices are at rest."""
        if self._ending is not None:
            return
        self._context.gate.open()
        self._ending = Ending(state, failure)
        self._next.discard()
        if self._attempt is not None:
            self._enter("stopping", failure.message)
            self._attempt.halt(failure.message)
        else:
            self._finish(state, failure)

    def _finish(self, state: EndState, failure: Failure | None) -> None:
        world = self._context.backend.cell.world
        judge = self._context.backend.capabilities.judge
        arms, with_physics = self._claims.devices_of(self.id), judge is not None and judge.has_physics
        self._claims.remove(self.id)
        self._always.end()
        self.state = self.end = state
        self.contact = "none"
        self.reason, self.failure = describe_failure(failure) if failure else "", failure
        if state == "succeeded":
            broken = [call for attempt in self.attempts for call in attempt.broken_calls]
            pushed = collect_forces(world, self._writes_before, broken, arms, with_physics)
            self.facts = (*collect_facts(self.attempts[-1], world, with_physics), *pushed)
        self.false_claims = () if judge is None else judge.find_false_claims()
        self._emit(
            TaskEnded(
                time=self._now,
                task=self.assignment.name,
                status=state,
                failure=failure,
                verified=self.verified,
                facts=self.facts,
                false_claims=self.false_claims,
            )
        )

    def _settle_state(self) -> None:
        """Take over how far a pause is, or for what the run waits."""
        if self._attempt is not None and self._ending is None:
            tree = self._attempt.tree
            reason = tree.waits_for if self._pause.state == "running" else self._pause.reason
            self._enter(self._pause.state, reason, contact=tree.contact)

    def _enter(
        self, state: State, reason: str = "", failure: Failure | None = None, contact: ContactState = "none"
    ) -> None:
        if (state, reason, contact) != (self.state, self.reason, self.contact):
            self._state_since = self._now if state != self.state else self._state_since
            self._limit.follow(state, self._now)
            self.state, self.reason, self.contact = state, reason, contact
            self._emit(StateChanged(time=self._now, state=state, reason=reason, failure=failure, contact=contact))

    def _emit(self, event: Event) -> None:
        for listener in self._context.listeners:
            listener(event)
