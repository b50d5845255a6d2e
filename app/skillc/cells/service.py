"""Serves a cell: takes requests, ticks the host at its pace, answers once what happened is durable, and reports."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import assert_never

import msgspec

from skillc.cells.host import CellHost
from skillc.cells.mailbox import ALIVE_S, Inbox, Outbox
from skillc.cells.operations.assigner import Assigned, Assigner
from skillc.contract.cell import CellStatus
from skillc.contract.messages import (
    Acknowledge,
    CellAnswer,
    CellRequest,
    Change,
    Disturb,
    Edit,
    End,
    Forget,
    Give,
    Happened,
    Look,
    Place,
    Refused,
    Reorder,
    Reset,
    Restore,
    Save,
    SetPace,
    StatusChanged,
    Submit,
    TakeCoverage,
    TakeGeometry,
    TakeLibrary,
    TakeSample,
    TakeSnapshot,
)
from skillc.errors import DiagnosticsError, RequestError, ServiceError
from skillc.services.reporting.diagnosis import diagnose
from skillc_runtime.execution.cell_loop import NotDurable, Request, TooManyRequests
from skillc_runtime.execution.pace import FAST

IDLE_S = 0.2
"""How long the loop waits for requests while nothing runs, in s of wall time."""
BUSY_S = 0.02
"""How long it waits at most while a tick is not due, or while nothing but planning goes on."""
ROUND_S = 0.005
"""How long requests are carried out, in s of wall time, before the next tick if one is due: stops take effect there."""


@dataclass(frozen=True, slots=True)
class _Pending:
    """A request that is answered after the next tick; `command` is what a run has obeyed or refused then.

    One that is not `durable` is done also if the journal cannot be written.
    """

    number: int
    command: Request | None = None
    durable: bool = True


class CellService:
    """The loop of the process of a cell."""

    def __init__(self, host: CellHost, inbox: Inbox, outbox: Outbox) -> None:
        self._host, self._inbox, self._outbox = host, inbox, outbox
        self._assigner = Assigner(inbox.wake)
        self._requested_end = "the server of the cell has ended"
        self._ending: str | None = None
        self._pending: list[_Pending] = []
        self._status: CellStatus | None = None
        self._looked = 0.0

    def end(self, reason: str) -> None:
        """Interrupt everything in the next round, and end; may be called from signal handlers."""
        self._requested_end = reason
        self._inbox.closed = True

    def run(self) -> None:
        """Serve until the process is asked to end, or whoever operates the cell is gone, and everything is at rest.

        Reports go before answers: whoever gets an answer has heard of the operation before.
        """
        idle = True
        while self._ending is None or self._host.loop.runs:
            self._outbox.rounds += 1
            self._take_requests(self._find_wait(idle))
            if self._inbox.closed and self._ending is None:
                self._end(self._requested_end)
            idle = not self._tick()
            self._report()
            self._answer()

    def _take_requests(self, wait_s: float) -> None:
        """Wait for requests for up to `wait_s`, and do what they say for ROUND_S at most; the others wait."""
        request = self._inbox.take(wait_s)
        end = time.monotonic() + ROUND_S
        if (assigned := self._assigner.take()) is not None:
            self._submit(assigned)
        while request is not None:
            self._take(request)
            request = self._inbox.take(0.0) if time.monotonic() < end else None

    def _find_wait(self, idle: bool) -> float:
        """Return how long to wait for requests before the next round; `idle` if nothing happened in the last one."""
        if self._assigner.ready:
            return 0.0
        if not self._host.loop.runs:
            return IDLE_S
        return BUSY_S if idle else min(BUSY_S, self._find_remaining())

    def _find_remaining(self) -> float:
        """Return for how long the next tick is not due, in s of wall time; a cell that stops does not wait."""
        runs = self._host.loop.runs
        if any(run.state == "stopping" for run in runs):
            return 0.0
        standing = all(run.stands for run in runs)
        return self._host.pace.remaining_s(self._host.loop.backend.clock.now, standing)

    def _tick(self) -> bool:
        """Tick if a tick is due, else only take requests; return whether anything goes on."""
        loop, intervals = self._host.loop, self._outbox.intervals
        if not loop.runs or self._find_remaining() > 0.0:
            self._host.obey()
            if not loop.runs:
                intervals.pause()
            return bool(loop.runs)
        intervals.begin_tick()
        moved = self._host.tick()
        if not moved:
            intervals.pause()
        return moved

    def _take(self, request: CellRequest) -> None:
        """Do what is requested, as far as that is possible before the next tick."""
        message, number = request.message, request.number
        with self._answering(number):
            if isinstance(message, Submit) and not message.request.continues:
                self._assigner.begin(number, message, self._host.library, self._host.world.snapshot())
            elif isinstance(message, Look):
                self._outbox.send(CellAnswer(number=number, result=self._look(message)))
            else:
                self._pending.append(self._carry_out(message, number))

    def _submit(self, assigned: Assigned) -> None:
        """Submit what was read; it is read again if the library is another one by now."""
        message, number, host = assigned.message, assigned.number, self._host
        with self._answering(number):
            if isinstance(assigned.result, ServiceError):
                raise assigned.result
            if assigned.library is host.library:
                host.submit(message.operation, message.request, assigned.result)
                self._pending.append(_Pending(number))
            else:
                self._assigner.begin(number, message, host.library, host.world.snapshot())

    @contextmanager
    def _answering(self, number: int) -> Iterator[None]:
        """Answer a request that cannot be done with the reason; a cell that ends does nothing more."""
        try:
            if self._ending is not None:
                raise RequestError(f"the cell ends: {self._ending}")
            yield
        except (ServiceError, TooManyRequests, NotDurable) as error:
            self._outbox.send(CellAnswer(number=number, refused=_refuse(error)))

    def _look(self, message: Look) -> bytes:
        """Return what is asked for; nothing changes."""
        match message:
            case TakeSnapshot(beside="devices"):
                return self._host.take_twin()
            case TakeSnapshot(beside=beside):
                return self._host.take_snapshot(with_arms=beside == "arms")
            case TakeSample():
                return msgspec.msgpack.encode(self._host.devices.sampler.take())
            case TakeGeometry():
                return self._host.devices.geometry.take_model()
            case TakeCoverage():
                return self._host.devices.geometry.take_coverage()
            case _:
                assert_never(message)

    def _carry_out(self, message: Change, number: int) -> _Pending:
        """Do what a message with a number says, and return what is answered after the next tick."""
        match message:
            case Submit(operation=operation, request=wanted):
                self._host.submit(operation, wanted)
            case Give(operation=operation, command=command):
                return _Pending(number, self._host.request(operation, command))
            case Reorder(first=first):
                self._host.reorder(first)
                return _Pending(number, durable=False)
            case SetPace(factor=factor):
                self._host.pace.set(FAST if factor is None else factor)
                return _Pending(number, durable=False)
            case Acknowledge():
                self._host.acknowledge()
            case Edit() | Place():
                self._host.edit(message)
            case Disturb(disturbance=disturbance, who=who):
                self._host.disturb(disturbance, who)
                return _Pending(number, durable=False)
            case Reset() | Save() | Restore() | Forget():
                self._host.checkpoint(message)
            case TakeLibrary(content=content):
                self._host.take_library(content)
            case End(reason=reason):
                self._end(reason)
            case _:
                assert_never(message)
        return _Pending(number)

    def _end(self, reason: str) -> None:
        """Interrupt all operations; the loop ends when everything is at rest."""
        self._ending = reason
        self._host.loop.interrupt(reason)

    def _answer(self) -> None:
        """Answer what was requested before the tick: it is durable now, unless the journal cannot be written."""
        fault = self._host.loop.fault
        for each in self._pending:
            refused = None
            if fault is not None and each.durable:
                refused = Refused(kind="state", reason=fault)
            elif each.command is not None and each.command.refused is not None:
                refusal = each.command.refused
                refused = Refused(kind="state", reason=str(refusal), allowed=refusal.allowed)
            self._outbox.send(CellAnswer(number=each.number, refused=refused))
        self._pending.clear()

    def _report(self) -> None:
        """Report what has changed."""
        for operation in self._host.take_changed():
            self._outbox.send(Happened(operation=operation))
        status = self._host.describe()
        if status != self._status:
            self._status = status
            self._outbox.send(StatusChanged(status=status))
        if time.monotonic() > self._looked + ALIVE_S:
            self._looked = time.monotonic()
            self._outbox.arms = self._host.devices.sampler.read_controls()


def _refuse(error: ServiceError | TooManyRequests | NotDurable) -> Refused:
    match error:
        case TooManyRequests():
            return Refused(kind="busy", reason=str(error))
        case DiagnosticsError():
            return Refused(kind="invalid", diagnosis=diagnose(error))
        case _:
            return Refused(kind="invalid", reason=str(error))
