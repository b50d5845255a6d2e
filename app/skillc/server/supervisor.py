"""Keeps the process of a cell going: starts it, ends it if it falls silent, and starts it again after it has died."""

from __future__ import annotations

import asyncio
import time
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import assert_never

from msgspec import structs

from skillc.cells.remote_cell import CellGone, RemoteCell, start_cell
from skillc.cells.settings import CellSettings
from skillc.contract.cell import CellStatus
from skillc.contract.messages import (
    Alive,
    CellAnswer,
    Happened,
    Message,
    Preparing,
    Refused,
    Report,
    StartFailed,
    StatusChanged,
)
from skillc.contract.operation import OperationStatus
from skillc.workers.library_check import CheckedLibrary
from skillc_runtime.recording.states import ENDS, State

SILENCE_S = 30.0
"""How long the loop of a cell may stand still before its process is ended, in s; see LOOK_S."""
LOOK_S = 1.0
"""The time between two looks at a cell, in s. A longer time counts as this one: the machine was busy or asleep then,
which is no fault of the cell."""
FIRST_DELAY_S, MAX_DELAY_S = 0.5, 60.0
"""How long to wait before a cell is started again: the delay doubles each time until a cell has run for SETTLED_S."""
SETTLED_S = 60.0
LONGEST_START_S = 600.0
"""How long a process may take until it is ready, in s; see LOOK_S. Its first start compiles the control laws."""
START_S = 20.0
"""How long requests wait for a cell that starts, in s."""
END_S = 20.0
"""How long a cell may take to come to rest and end, in s."""
LOG = "log"


class CellSupervisor:
    """One cell of a server. `status` is how it is, `operations` are those that go on; `publish` hears what happens.

    `find_obstacle` returns why its process must not be started now; empty if it may.

    `starts` counts how often its process was started, `ended` the operations that ended, by state. `alive` is what the
    process has said last of its loop.
    """

    def __init__(
        self,
        settings: CellSettings,
        publish: Callable[[Happened | StatusChanged], None],
        find_obstacle: Callable[[], str] = lambda: "",
    ) -> None:
        self.settings, self._find_obstacle = settings, find_obstacle
        self.status = _off(settings, "it has not been started")
        self.operations: dict[str, OperationStatus] = {}
        self.starts, self.ended = 0, Counter[State]()
        self._publish = publish
        self._cell: RemoteCell | None = None
        self.alive, self._silent_s = Alive(rounds=0), 0.0
        self._settled = asyncio.Event()  # whether it has started, or failed to
        self._problem = self._library_problem = self._ended = ""

    @property
    def ready(self) -> bool:
        """Whether the cell takes requests."""
        return self._cell is not None and self.status.state != "off"

    async def keep_going(self) -> None:
        """Start the cell, and start it again whenever it has died, until this is cancelled; then end it."""
        delay_s = FIRST_DELAY_S
        try:
            while True:
                began = time.monotonic()
                await self._live()
                delay_s = FIRST_DELAY_S if time.monotonic() - began > SETTLED_S else delay_s
                await asyncio.sleep(delay_s)
                delay_s = min(2.0 * delay_s, MAX_DELAY_S)
        finally:
            await self._end()

    async def request(self, message: Message) -> Refused | bytes:
        """Give a message to the cell; return why it was refused, else what it asks for: it is done and durable.

        A cell that starts is waited for, START_S at most.
        """
        with suppress(TimeoutError):
            async with asyncio.timeout(START_S):  # unlike wait_for, it never loses a cancellation
                await self._settled.wait()  # wait ends: with the timeout
        if self._cell is None or not self.ready:
            return Refused(kind="off", reason=f"{self.settings.name} is off: {self.status.reason}")
        try:
            answer = await self._cell.request(message)
        except CellGone as error:
            return Refused(kind="off", reason=f"{error}; whether it has done what was requested, its journal says")
        return answer.refused or answer.result

    def set_library(self, checked: CheckedLibrary, problem: str) -> None:
        """Let the cell start with a library from now on; `problem` is why that is not the one on disk."""
        self.settings = structs.replace(self.settings, content=checked.content)
        self._library_problem = problem
        self._set_status(self.status)

    def stop(self, reason: str, operation: str | None = None) -> None:
        """Stop an operation in the next tick, or all; a cell that is off has nothing to stop."""
        if self._cell is not None:
            self._cell.stop(reason, operation)

    async def _live(self) -> None:
        """Start the process of the cell, and return when it has ended."""
        folder = Path(self.settings.folder)
        folder.mkdir(parents=True, exist_ok=True)
        self._problem = ""
        self._settled.clear()
        if obstacle := await asyncio.to_thread(self._find_obstacle):
            self._set_status(_off(self.settings, obstacle))
            self._settled.set()
            return
        self._set_status(_off(self.settings, "it starts"))
        try:
            with (folder / LOG).open("a", encoding="utf-8") as log:
                self._cell = await start_cell(structs.replace(self.settings, ended=self._ended), log, self._hear)
        except OSError as error:
            self._set_status(_off(self.settings, f"its process cannot be started: {error.strerror or error}"))
            self._settled.set()
            return
        self.starts += 1
        await self._watch(self._cell)
        self._bury(self._cell.gone.result())

    async def _watch(self, cell: RemoteCell) -> None:
        """Return when the process of a cell has ended; end it if it falls silent."""
        self._silent_s, before = 0.0, time.monotonic()
        while not cell.gone.done():
            await asyncio.wait((cell.gone,), timeout=LOOK_S)
            now = time.monotonic()
            self._silent_s += min(now - before, LOOK_S)
            before = now
            limit_s = SILENCE_S if self.ready else LONGEST_START_S
            if self._silent_s > limit_s and not cell.gone.done():
                what = "its loop stood still for" if self.ready else "it was not ready within"
                self._problem = f"{what} {limit_s:g} s, so its process was ended"
                cell.kill()

    def _bury(self, code: int) -> None:
        """The process has ended: nothing of it goes on."""
        self._cell, self.alive = None, Alive(rounds=0)
        self._settled.set()
        reason = self._problem or f"its process ended with {f'signal {-code}' if code < 0 else f'code {code}'}"
        self._ended = reason
        for operation in tuple(self.operations.values()):
            now = datetime.now(UTC)
            ended = structs.replace(operation, state="interrupted", reason=reason, allowed=(), ended_at=now)
            self._hear(Happened(operation=ended))
        self._set_status(_off(self.settings, reason))

    async def _end(self) -> None:
        """Let the cell come to rest and end; end its process if it does not."""
        if self._cell is None:
            return
        cell, self._problem = self._cell, "the server ends"
        cell.abandon()
        await asyncio.wait((cell.gone,), timeout=END_S)
        cell.kill()
        self._bury(await cell.gone)

    def _hear(self, report: Report) -> None:
        """Take a report of the cell."""
        match report:
            case Happened(operation=operation):
                if operation.state in ENDS:
                    self.operations.pop(operation.id, None)
                    self.ended[operation.state] += 1
                else:
                    self.operations[operation.id] = operation
                self._publish(report)
            case StatusChanged(status=status):
                if not self.ready:
                    self._silent_s = 0.0  # how long it was silent while it started counts no more
                self._set_status(status)
                self._settled.set()
            case Alive(rounds=rounds):
                if rounds != self.alive.rounds:
                    self._silent_s = 0.0
                self.alive = report
            case Preparing(reason=reason):
                self._set_status(_off(self.settings, f"it starts: {reason}"))
            case StartFailed(reason=reason):
                self._problem = reason
            case CellAnswer():
                raise AssertionError("answers go to who waits for them")
            case _:
                assert_never(report)

    def _set_status(self, status: CellStatus) -> None:
        status = structs.replace(status, library_problem=self._library_problem)
        if status != self.status:
            self.status = status
            self._publish(StatusChanged(status=status))


def _off(settings: CellSettings, reason: str) -> CellStatus:
    return CellStatus(
        name=settings.name,
        scene=settings.scene,
        library=settings.library,
        library_hash="",
        backend=settings.backend,
        state="off",
        reason=reason,
    )
