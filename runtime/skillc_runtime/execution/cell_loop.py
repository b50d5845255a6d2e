"""The loop of a cell: it owns the clock, takes requests, and ticks the task runs, several on disjoint devices."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from itertools import count

from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.backend import Backend
from skillc_runtime.execution.assignment import Assignment
from skillc_runtime.execution.attempt import TICK_S, CellOrigin, RunContext
from skillc_runtime.execution.device_claims import ClaimedLocks, DeviceClaims, is_device
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.preparation import StartPreparation
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.execution.task_state import RefusedCommand
from skillc_runtime.execution.tree.context import EPSILON_S
from skillc_runtime.execution.tree.gate import Gate
from skillc_runtime.recording.commands import Abort, Command, Stop
from skillc_runtime.recording.events import Listener
from skillc_runtime.recording.listeners import Listeners
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS

MAX_REQUESTS = 1000
"""How many requests may wait for the next tick; stops are not among them."""


class NotDurable(Exception):
    """What has happened cannot be written down; the message says why, and what to do."""


class TooManyRequests(Exception):
    """So many requests wait for the next tick that no more are taken."""


@dataclass(eq=False, slots=True)
class Request:
    """A command for a task run; `answered` once it was obeyed or refused in a tick, `refused` is why then."""

    run: TaskRun
    command: Command
    answered: bool = False
    refused: RefusedCommand | None = None

    def answer(self, tick: int) -> None:
        """Let the run obey or refuse."""
        self.refused = self.run.request(self.command, tick)
        self.answered = True


@dataclass(slots=True)
class CellLoop:
    """Ticks the task runs of a cell; whoever drives it calls `tick` again and again, at the pace that it wants.

    `runs` are those that have not ended, in the order in which those that wait get planners and devices: a higher
    priority comes first, then who was submitted first, unless they are `reorder`ed. `ticks` counts
    the ticks in which anything happened: requests and plans are recorded with this number, so that a run can be
    repeated. `after_tick` are called whenever time has passed. `request` and `stop` may be called from other threads
    and from signal handlers.

    `follow_s` is how often, in s, the cell looks for what others write to its world; infinite if nobody else does.
    A cell without devices, where nothing else happens, skips no more time than that.

    `commit` is called in each tick after the runs were ticked, before time passes: it makes durable what has happened,
    so that nothing moves because of what a dead process would have forgotten. If it raises NotDurable, `fault` is why,
    and all runs fail, until somebody sets it back to None; time passes only so that their devices come to rest.
    """

    backend: Backend
    library: SkillLibrary
    start_preparation: StartPreparation
    origin: CellOrigin = field(default_factory=CellOrigin)
    after_tick: Sequence[Callable[[], None]] = ()
    commit: Callable[[], None] = lambda: None
    fault: str | None = None
    follow_s: float = math.inf
    runs: list[TaskRun] = field(default_factory=list)
    ticks: int = 0
    _claims: DeviceClaims = field(default_factory=DeviceClaims)
    _requests: deque[Request] = field(default_factory=deque)
    _stops: deque[Request] = field(default_factory=deque)
    _numbers: count[int] = field(default_factory=lambda: count(1))

    def submit(
        self,
        assignment: Assignment,
        listeners: Sequence[Listener] = (),
        spec: RunSpec | None = None,
        gate: Gate | None = None,
        run_id: str = "",
        start_preparation: StartPreparation | None = None,
    ) -> TaskRun:
        """Add a task run; it begins with the next tick, or when other runs give back the devices that it needs.

        `spec` is what is to be done and how, `gate` has its breakpoints.
        Its id is the name of the task with a number unless `run_id` is given.
        `start_preparation` prepares it in place of that of the loop.
        """
        name = run_id or f"{assignment.name}-{next(self._numbers)}"
        heard = (Listeners(listeners),) if listeners else ()
        spec = spec or RunSpec()
        context = RunContext(
            self.library,
            self.backend,
            heard,
            FailedSteps(self.library),
            gate or Gate(),
            ClaimedLocks(self._claims, name, self._is_device),
            self.origin,
            spec,
        )
        start = start_preparation or self.start_preparation
        run = TaskRun(name, assignment, context, self._claims, start)
        before = (place for place, each in enumerate(self.runs) if each.spec.priority >= spec.priority)
        self.runs.insert(max(before, default=-1) + 1, run)
        self._claims.order([each.id for each in self.runs])
        return run

    def reorder(self, first: Sequence[TaskRun]) -> None:
        """Put these runs before all others that wait, in this order."""
        others = [each for each in self.runs if each not in first]
        ahead = next((place for place, each in enumerate(others) if each.waits), len(others))
        self.runs = [*others[:ahead], *first, *others[ahead:]]
        self._claims.order([each.id for each in self.runs])

    def request(self, run: TaskRun, command: Command) -> Request:
        """Give a command to a run in the next tick. TooManyRequests if as many as possible wait; a stop always goes."""
        request = Request(run, command)
        if isinstance(command, Stop | Abort):
            self._stops.append(request)
        elif len(self._requests) < MAX_REQUESTS:
            self._requests.append(request)
        else:
            raise TooManyRequests(f"{MAX_REQUESTS} requests wait for the next tick; try again later")
        return request

    def stop(self, reason: str, run: TaskRun | None = None) -> None:
        """Stop a run in the next tick, or all."""
        for each in tuple(self.runs) if run is None else (run,):
            self._stops.append(Request(each, Stop(reason)))

    def abort(self, reason: str) -> None:
        """Let all runs fail in the next tick, because devices have stopped by themselves."""
        for each in self.runs:
            self._stops.append(Request(each, Abort(reason)))

    @property
    def is_computing(self) -> bool:
        """Whether time stands still until what skills compute is done."""
        computing = False
        for run in self.runs:  # a loop, as in each tick: generators cost more than what they ask
            if run.computing:
                computing = True
            elif run.needs_time:
                return False
        return computing and self.backend.capabilities.lock_step is not None

    def tick(self) -> bool:
        """Do one tick; return whether anything happened. If not, at most planning goes on, and time stands still.

        In lock step it also does while all that needs time waits for what skills compute beside the ticks, so that the
        speed of the machine changes nothing.
        """
        if self.is_computing:
            self.obey()
            return False
        happened = self._take_requests()
        for run in self.runs:
            happened |= run.tick(self.ticks)
        self._commit()
        for run in self.runs:
            if run.needs_time:
                self._advance()
                happened = True
                break
        for run in self.runs:
            if run.end is not None:
                self.runs = [each for each in self.runs if not each.ended]
                break
        self.ticks += happened
        return happened

    @property
    def waits_for_others(self) -> bool:
        """Whether nothing will happen until others write to the world: time passes as on the wall then, to wait."""
        shared = self.backend.capabilities.symbolic and not math.isinf(self.follow_s)
        return shared and all(run.waits_for_facts for run in self.runs)

    def obey(self) -> None:
        """Take requests and stops while no tick is due: they take effect now, and no time passes."""
        self._take_requests()
        self._commit()

    def interrupt(self, reason: str) -> None:
        """Halt all runs because nobody operates the cell any more; they end as interrupted."""
        for run in self.runs:
            run.end_as("interrupted", reason)

    def wait(self, seconds: float) -> None:
        """Wait for up to `seconds` of wall time for what is planned or computed, after a tick without a happening."""
        ways = (run for run in self.runs if run.computing or (run.state == "planning" and not run.waits_for))
        if (waiting := next(ways, None)) is not None:
            waiting.wait(seconds)

    def close(self, reason: str) -> None:
        """End all runs at once, because the program ends; requests that still wait are refused."""
        for run in self.runs:
            self._stops.append(Request(run, Stop(reason, at_once=True)))
        self._take_requests()
        self.runs = []

    def _is_device(self, individual: str) -> bool:
        return is_device(individual, self.backend.cell.world.snapshot())

    def _take_requests(self) -> bool:
        """Give the stops, then the other requests that wait now, to their runs; return whether there were any."""
        if not self._stops and not self._requests:
            return False
        waiting = (*_take_all(self._stops), *_take_all(self._requests))
        for request in waiting:
            request.answer(self.ticks)
        return True

    def _commit(self) -> None:
        """Make durable what has happened; fail all runs if that is not possible."""
        try:
            self.commit()
        except NotDurable as error:
            self.fault = str(error)
        if self.fault is not None:
            for run in self.runs:
                run.end_as("failed", self.fault)

    def _advance(self) -> None:
        """Let time pass; an error of the cell fails all runs."""
        try:
            self.backend.advance(self._next_step_s)
        except FOREIGN_ERRORS as error:  # the boundary to the cell: every run reports, halts and ends
            for run in self.runs:
                run.abort(error)
        for hook in self.after_tick:
            hook()

    @property
    def _next_step_s(self) -> float:
        """How long, in s, until the next tick: where there are no devices, as many ticks as would change nothing."""
        if not self.backend.capabilities.symbolic:
            return TICK_S
        idle_s = min(run.find_idle_s() for run in self.runs if run.needs_time)
        idle_s = min(idle_s, self.follow_s)
        ticks = 1 if math.isinf(idle_s) else max(1, math.ceil(idle_s / TICK_S - EPSILON_S))
        return ticks * TICK_S


def _take_all(requests: deque[Request]) -> Iterable[Request]:
    """Take those that are in the queue now; others may be added meanwhile, by other threads or signal handlers."""
    return [requests.popleft() for _ in range(len(requests))]
