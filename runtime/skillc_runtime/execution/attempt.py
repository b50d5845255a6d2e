"""One attempt at a task: a body that runs in a cell from its first tick until everything is at rest."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.prompts import Prompt
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PlannedSteps, PreparedTask
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.plans.monitor import PlanMonitor
from skillc_runtime.execution.plans.plan_record import restore_postures
from skillc_runtime.execution.plans.progress import measure_progress
from skillc_runtime.execution.success_facts import BrokenCall, Claim
from skillc_runtime.execution.tree.gate import Gate
from skillc_runtime.execution.tree.locks import DeviceLocks
from skillc_runtime.execution.tree.run import AttemptInputs, TreeRun
from skillc_runtime.planning.plan import Step
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import Listener, Note, PromptsChanged
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.history.node_outcome import NodeOutcome
from skillc_runtime.recording.run_spec import RunSpec

TICK_S = 0.01
"""The tree is ticked at 100 Hz of the cell's time: every ten control periods."""

SETTLE_S, FALL_S = 5.0, 2.0
"""How long, after the end, devices may take to come to rest, and then what lies free, which nobody holds."""


class CellOrigin(msgspec.Struct, frozen=True):
    """What a simulated cell was built from: the file of its scene, empty if it came from elsewhere, the seed, and how.

    `backend` is the name of the backend, empty if the cell was built by a program.
    """

    scene: str = ""
    seed: int = 0
    backend: str = ""


class RunContext(msgspec.Struct, frozen=True):
    """What all attempts of a task run share.

    `listeners` get the events. `failures` collects the steps of plans that fail. `gate` holds calls back where the run
    pauses; `locks` are those of the devices that it holds. `spec` is what is to be done and how.
    """

    library: SkillLibrary
    backend: Backend
    listeners: Sequence[Listener]
    failures: FailedSteps
    gate: Gate
    locks: DeviceLocks
    origin: CellOrigin
    spec: RunSpec

    def emit_notes(self, messages: Sequence[str]) -> None:
        """Emit messages for users."""
        for message in messages:
            for listener in self.listeners:
                listener(Note(time=self.backend.clock.now, message=message))


class AttemptResult(msgspec.Struct, frozen=True):
    """How a body ended, its tree and the number of its last node.

    `invalidated` says why the plan no longer led to the goal, if it was halted for that. `claims` are the posts of the
    outermost calls that succeeded, `broken_calls` what did not.
    """

    prepared: PreparedTask
    status: Status
    failure: Failure | None
    tree: NodeOutcome
    last_node: int
    invalidated: str | None
    claims: tuple[Claim, ...] = ()
    broken_calls: tuple[BrokenCall, ...] = ()

    @property
    def is_look(self) -> bool:
        """Whether it was the part of a policy up to a step that decides how it goes on, and succeeded."""
        planned = self.prepared.planned
        return self.status is Status.SUCCESS and planned is not None and bool(planned.solved.plan.branches)

    @property
    def reason(self) -> str:
        """Why another plan may be needed."""
        if self.invalidated is not None:
            return f"the plan no longer leads to the goal: {self.invalidated}"
        return self.failure.message if self.failure else "the goal does not hold after the plan"

    def steps_with_status(self, *statuses: str) -> tuple[Step, ...]:
        """Return the steps of the plan that ended with a status, in the order of the body; none without a plan."""
        planned = self.prepared.planned
        if planned is None:
            return ()
        progress = measure_progress(planned.steps, self.tree)
        return tuple(step for step, outcome in progress if outcome.status in statuses)


class Attempt:
    """Runs a body until it ends or its plan becomes invalid, then waits until its devices are at rest.

    In a cell whose truth is known it waits as well until nothing falls or rolls: its claims are judged at its end.

    `ticking` while the tree runs; `ended` once everything is at rest.
    """

    def __init__(self, prepared: PreparedTask, context: RunContext, nodes_before: int) -> None:
        """Build the tree, whose nodes are numbered from `nodes_before` + 1; nothing starts."""
        cell = context.backend.cell
        failures = None if prepared.planned is None else context.failures
        postures = () if prepared.space is None else restore_postures(prepared.space)
        self.prepared, self._context = prepared, context
        self.tree = TreeRun(
            prepared.body,
            context.library,
            cell,
            context.listeners,
            context.locks,
            AttemptInputs(nodes_before, failures, postures),
            context.gate,
            context.spec,
        )
        self.ticking, self.ended = True, False
        self._invalidated: str | None = None
        self._monitor = self._watch_plan()
        self._settling_ticks = self._falling_ticks = 0
        self._asked: tuple[Prompt, ...] = ()

    def tick(self, devices: frozenset[str] | None) -> None:
        """Tick the tree once, or wait for `devices`, all if None, to come to rest after its end."""
        if self.ticking:
            self._tick_tree()
        self._tell_prompts()
        if self.tree.status is Status.RUNNING:
            return
        self._secure(devices)
        if self._devices_rest(devices) and self._things_lie():
            self.tree.check_devices()
            self.ended = True

    def halt(self, reason: str) -> None:
        """Halt the tree; the attempt ends when everything is at rest."""
        self.tree.halt(reason)

    def end_at_once(self, devices: frozenset[str] | None) -> None:
        """End after `halt` without waiting until `devices`, all if None, are at rest."""
        self._secure(devices)
        self.ended = True

    def invalidate(self, reason: str) -> None:
        """Halt the tree because its plan is not to be followed any more."""
        self._invalidated = reason
        self.tree.halt(f"the plan no longer leads to the goal: {reason}")

    def result(self) -> AttemptResult:
        """Return how the attempt ended."""
        tree = self.tree
        return AttemptResult(
            self.prepared,
            tree.status,
            tree.failure,
            tree.outcome,
            tree.last_node,
            self._invalidated,
            tree.claims,
            tree.broken_calls,
        )

    def _tell_prompts(self) -> None:
        """Emit what operators are asked, if that has changed."""
        if (prompts := self.tree.active.prompts) != self._asked:
            self._asked = prompts
            for listener in self._context.listeners:
                listener(PromptsChanged(time=self._context.backend.clock.now, prompts=self._asked))

    def _secure(self, devices: frozenset[str] | None) -> None:
        """Secure devices once, after the tree has ended."""
        if self.ticking:
            self.ticking = False
            if self._monitor is not None:
                self._monitor.stop()
            self._context.emit_notes(self._context.backend.secure(devices))

    def _devices_rest(self, devices: frozenset[str] | None) -> bool:
        """Whether devices are at rest, or have had enough time for that."""
        backend = self._context.backend
        if backend.broken is not None or backend.is_at_rest(devices):
            return True
        self._settling_ticks += 1
        return self._settling_ticks > round(SETTLE_S / TICK_S)

    def _things_lie(self) -> bool:
        """Whether nothing falls or rolls, as far as that is known, or has done so for long enough."""
        judge = self._context.backend.capabilities.judge
        if judge is None or judge.things_lie_still:
            return True
        self._falling_ticks += 1
        return self._falling_ticks > round(FALL_S / TICK_S)

    def _watch_plan(self) -> PlanMonitor | None:
        match self.prepared:
            case PreparedTask(Assignment(objective=AchieveGoal()) as assignment, planned=PlannedSteps() as planned):
                world, library = self._context.backend.cell.world, self._context.library
                end = None if planned.solved.plan.branches else assignment.plan_goal(library)
                known = assignment.plan_library(library)
                return PlanMonitor(planned.steps, end, known, world, lambda: self.tree.outcome)
            case _:
                return None

    def _tick_tree(self) -> None:
        """Tick the tree; halt it if the world has changed so that the plan no longer leads to the goal."""
        if self._monitor is None:
            self.tree.tick()
            return
        status = self._monitor.follow(self.tree.tick)
        reason = self._monitor.find_invalidation() if status is Status.RUNNING else None
        if reason is not None:
            self.invalidate(reason)
