"""The run of one behaviour tree in a cell."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from skillc_model import tree
from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.cell import Cell, WatchdogTimeout
from skillc_runtime.execution.success_facts import BrokenCall, Claim
from skillc_runtime.execution.tree.active_path import ActivePath
from skillc_runtime.execution.tree.build import build_node
from skillc_runtime.execution.tree.calls.call_node import CallNode
from skillc_runtime.execution.tree.calls.event_factory import make_change_event
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.errors import make_error
from skillc_runtime.execution.tree.gate import Gate
from skillc_runtime.execution.tree.lexical_scope import CallFailures, LexicalScope
from skillc_runtime.execution.tree.locks import DeviceLocks, describe_waits
from skillc_runtime.execution.tree.node import FAILURE, RUNNING
from skillc_runtime.execution.tree.pause import PrimitivePause
from skillc_runtime.execution.tree.reading import collect_claims, collect_outcome, find_active_calls
from skillc_runtime.execution.tree.undo_stack import UndoStack
from skillc_runtime.primitives.fact_monitor import FactMonitor
from skillc_runtime.primitives.planned_postures import PlannedPosture
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.primitives.standing_bases import place_standing_bases
from skillc_runtime.recording.contact import ContactState
from skillc_runtime.recording.events import Listener
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.history.node_outcome import NodeOutcome
from skillc_runtime.recording.listeners import Listeners
from skillc_runtime.recording.run_spec import AS_USUAL, RunSpec
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS
from skillc_runtime.world.state.transactions import ChangeEvent

_ALIVE = (RUNNING, Status.IDLE)


class AttemptInputs(NamedTuple):
    """What a tree gets of its task: it numbers its nodes from `nodes` + 1, so that all trees share a recording.

    Calls skip implementations that would fail again according to `failures`, and add their own failures. Arms take
    `postures`, with which the plan was looked at in space.
    """

    nodes: int = 0
    failures: CallFailures | None = None
    postures: tuple[PlannedPosture, ...] = ()


ALONE = AttemptInputs()


class TreeRun:
    """Runs the body of a task, the body of a plan, or a single call.

    `status` is IDLE before the first tick, then RUNNING, and at the end SUCCESS, FAILURE or HALTED; `failure` is the
    reason. `active` are the primitives that go on. Scoped skills that run outside any `with` are undone at the end.
    """

    def __init__(
        self,
        body: tree.Node,
        library: SkillLibrary,
        cell: Cell,
        listeners: Sequence[Listener] = (),
        locks: DeviceLocks | None = None,
        inputs: AttemptInputs = ALONE,
        gate: Gate | None = None,
        spec: RunSpec = AS_USUAL,
    ) -> None:
        """Build the tree; nothing starts.

        Runs on the same devices share `locks`. `inputs` are those of the task that is attempted. `gate` holds
        calls back where the run pauses. `spec` has the settings of the run, such as its speed.
        """
        self._listeners = Listeners(listeners)
        emit = self._listeners if listeners else None
        self._context = TreeContext(
            library, cell, emit, locks or DeviceLocks(), inputs.nodes, gate, spec, inputs.postures
        )
        self.active = self._context.active
        self._undo = UndoStack()
        self._stop_listening = cell.world.subscribe(self._emit_world_change) if listeners else None
        self._root = build_node(body, self._context, LexicalScope(self._undo, failures=inputs.failures))
        self._path = ActivePath(self._root)
        self._pause = PrimitivePause(self._context)
        self._devices = FactMonitor(cell)
        self._before_tick: tuple[object, int, int] = (None, 0, 0)
        self.status = Status.IDLE
        self.failure: Failure | None = None

    @property
    def paused(self) -> bool:
        """Whether the run is paused; also while withdrawn tools approach."""
        return self._pause.phase != "none"

    @property
    def awaits_result(self) -> bool:
        """Whether a primitive waits for what it computes, however far that is."""
        return self._context.computations.awaited

    @property
    def computing(self) -> bool:
        """Whether primitives wait for what they compute beside the ticks, and the run is not paused."""
        return self.status is RUNNING and self._context.computations.pending and not self.paused

    @property
    def withdrawn(self) -> bool:
        """Whether the tools of a paused run were taken off, and have not been brought back yet."""
        return self._pause.phase in ("withdrawn", "approaching")

    @property
    def contact(self) -> ContactState:
        """What becomes of the tools that pressed when the run was paused."""
        return self._pause.contact

    @property
    def is_still(self) -> bool:
        """Whether the run is paused and the devices that it has used have come to rest; pushes may go on."""
        return self._pause.is_still

    @property
    def idle_s(self) -> float:
        """For how long, in s, ticks would change nothing by themselves; 0 if the last one did, or that is not known.

        Infinite if nothing waits for a time. Whatever comes from outside still may change something. Only what takes
        part in the tree is known: devices may change something in each tick.
        """
        context = self._context
        now = context.cell.world.snapshot(), context.happenings, context.locks.table.changes
        if self.status is not RUNNING or self.paused or self.awaits_result or self._before_tick != now:
            return 0.0
        return context.find_next_due()

    @property
    def last_node(self) -> int:
        """The number of the last node."""
        return self._context.last_id

    @property
    def outcome(self) -> NodeOutcome:
        """The tree with the current status of each node."""
        return collect_outcome(self._root)

    @property
    def active_calls(self) -> tuple[CallNode, ...]:
        """The innermost calls that run or wait, in the order of the tree."""
        return tuple(find_active_calls(self._root))

    def holds_back(self, call: CallNode) -> bool:
        """Tell whether a call waits at the gate, and has not started."""
        return self._context.gate is not None and self._context.gate.holds_back(call)

    @property
    def waits_for(self) -> str:
        """Which calls wait for what others use, in the order in which they came; empty if none does."""
        locks, short = self._context.locks, self._context.library.vocabulary.short
        return describe_waits(locks.find_conflicts(), short, locks.run) if locks.table.waits else ""

    @property
    def claims(self) -> tuple[Claim, ...]:
        """The posts of the outermost calls that succeeded, with the values of their variables."""
        return tuple(collect_claims(self._root))

    @property
    def broken_calls(self) -> tuple[BrokenCall, ...]:
        """The calls that failed, and of a run without success those that were halted: it is not known how far."""
        succeeded = self.status is Status.SUCCESS
        return tuple(each for each in self._context.broken_calls if each.status == "failed" or not succeeded)

    @property
    def listener_problems(self) -> tuple[str, ...]:
        """The errors raised by listeners."""
        return tuple(self._listeners.problems)

    def wait(self, seconds: float) -> None:
        """Wait for up to `seconds` of wall time for what is computed beside the ticks."""
        self._context.computations.wait(seconds)

    def tick(self) -> Status:
        """Read the clock, take a snapshot of the world and tick the tree once; return the status.

        While paused, it only sends the heartbeat, looks for faults of arms, and lets withdrawn tools approach.
        """
        if self.status not in _ALIVE:
            return self.status
        if self.paused:
            self._guard(self._tick_paused)
            return self.status
        try:
            self._context.begin_tick()
            context = self._context
            self._before_tick = context.state, context.happenings, context.locks.table.changes
            self._send_heartbeat()
            contradiction = self._find_contradiction()
            status = self._path.tick_leaf() if self.status is RUNNING else self._start()
            running = status is RUNNING or self._path.propagate(status) is RUNNING
            if contradiction is not None and self._root.status is not FAILURE:
                return self._fail_contradicted(contradiction)
            if running:
                return RUNNING
        except FOREIGN_ERRORS as error:  # the task's boundary: it reports, halts and ends
            self.abort(error)
            return self.status
        return self._finish(self._root.status, self._root.failure)

    def halt(self, reason: str) -> None:
        """Halt all running nodes, undo scoped skills, and end the run; no effect after the end."""
        if self.status in _ALIVE:
            self._context.begin_tick()
            self._root.halt(reason)
            self._finish(Status.HALTED, Failure(kind="halted", message=reason, source=self._root.source))

    def abort(self, error: BaseException) -> None:
        """Fail because of an error, for example of the cell: halt all running nodes, undo scoped skills and end."""
        if self.status in (Status.IDLE, RUNNING):
            failure = make_error(error, self._root.source)
            self._root.halt(failure.message)
            self._finish(Status.FAILURE, failure)

    def check_devices(self) -> None:
        """Write where bases stand that stopped on their way; turn a success into a failure if a device contradicts it.

        Called after the end.
        """
        cell = self._context.cell
        stop_listening = cell.world.subscribe(self._emit_world_change)
        try:
            place_standing_bases(cell)
            contradiction = self._devices.withdraw_contradicted() if self.status is Status.SUCCESS else None
        finally:
            stop_listening()
        if contradiction is not None:
            self.status, self.failure = Status.FAILURE, self._contradiction_failure(contradiction)

    def answer(self, prompt: int, choice: str) -> None:
        """Give the skill with a prompt of `prompts` what an operator has chosen."""
        self._guard(lambda: self.active.answer(prompt, choice))

    def pause(self) -> None:
        """Pause the active primitives and the run's own time; withdraw tools that approach again after a pause."""
        if self.status is RUNNING:
            self._guard(self._pause.begin)

    def withdraw(self) -> None:
        """Take the tools of a paused run off what they press on."""
        self._guard(self._pause.withdraw)

    def resume(self) -> None:
        """Continue after `pause`; if tools were withdrawn, as soon as they are in contact again."""
        self._guard(self._pause.end)

    def _send_heartbeat(self) -> None:
        if not self._context.cell.watchdog.beat(self, self._context.time):
            raise WatchdogTimeout("the tree was not ticked for too long, so everything was stopped")

    def _find_contradiction(self) -> str | None:
        """Retract the facts that a device contradicts; return a description of them, or None."""
        found = self._devices.withdraw_contradicted()
        if found is not None:
            self._context.refresh_state()
        return found

    def _fail_contradicted(self, contradiction: str) -> Status:
        """Halt all running nodes and fail because a device contradicts the world model."""
        self._root.halt(contradiction)
        return self._finish(Status.FAILURE, self._contradiction_failure(contradiction))

    def _contradiction_failure(self, contradiction: str) -> Failure:
        return Failure(kind="contradiction", message=contradiction, source=self._root.source)

    def _tick_paused(self) -> None:
        self._context.begin_tick()
        self._send_heartbeat()
        self._pause.tick()

    def _guard(self, work: Callable[[], None]) -> None:
        """Do something that calls primitives; an error fails the run."""
        try:
            work()
        except FOREIGN_ERRORS as error:  # the task's boundary: it reports, halts and ends
            self.abort(error)

    def _start(self) -> Status:
        self.status = RUNNING
        return self._path.start()

    def _finish(self, status: Status, failure: Failure | None) -> Status:
        for problem in self._undo.unwind():
            self._context.note(f"not undone at the end: {problem}")
        if self._stop_listening is not None:
            self._stop_listening()
        self._context.computations.close()
        self._context.cell.watchdog.retire(self)
        self.status, self.failure, self._pause.phase = status, failure, "none"
        self._pause.contact = "none"
        return status

    def _emit_world_change(self, event: ChangeEvent) -> None:
        self._context.time = self._context.cell.now  # others change the world between ticks
        self._listeners(make_change_event(event, self._context.time))
