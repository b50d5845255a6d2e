"""A cell that starts slowly is waited for, and one that never is ready is ended."""

from __future__ import annotations

import asyncio
import os
import signal
import time
from collections.abc import Awaitable, Callable
from contextlib import suppress
from pathlib import Path

import pytest
from msgspec import structs

from running_cells.yard import write_yard
from skillc.server import supervisor
from skillc.server.supervisor import CellSupervisor
from waiting import LONG_S


def start(
    folder: Path,
    import_s: float,
    until: Callable[[CellSupervisor], bool],
    then: Callable[[CellSupervisor], Awaitable[None]] | None = None,
) -> CellSupervisor:
    """Keep a cell going whose library names a module that takes long to import, until a condition holds, and `then`."""
    (folder / "slow_to_import.py").write_text(f"import time\ntime.sleep({import_s})\n", encoding="utf-8")
    cell = CellSupervisor(structs.replace(write_yard(folder), modules=("slow_to_import",)), lambda _: None)

    async def wait() -> None:
        going = asyncio.create_task(cell.keep_going())
        try:
            async with asyncio.timeout(LONG_S):
                while not until(cell):
                    await asyncio.sleep(0.02)
                if then is not None:
                    await then(cell)
        finally:
            going.cancel()
            with suppress(asyncio.CancelledError):
                await going

    asyncio.run(wait())
    return cell


def test_a_cell_that_starts_slowly_is_waited_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(supervisor, "SILENCE_S", 1.0)
    assert start(tmp_path, 2.0, lambda cell: cell.ready).starts == 1


def test_a_cell_that_is_never_ready_is_ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(supervisor, "LONGEST_START_S", 1.0)
    assert start(tmp_path, 600.0, lambda cell: "it was not ready within 1 s" in cell.status.reason).starts == 1


def process_of(cell: CellSupervisor) -> int:
    assert cell._cell is not None
    return cell._cell.pid


async def let_the_machine_stand_still(cell: CellSupervisor) -> None:
    """Nobody does anything for longer than a cell may be silent: neither its process nor this one."""
    os.kill(process_of(cell), signal.SIGSTOP)
    time.sleep(3.0 * supervisor.SILENCE_S)
    os.kill(process_of(cell), signal.SIGCONT)
    rounds = cell.alive.rounds
    while cell.alive.rounds == rounds and cell.ready:
        await asyncio.sleep(0.02)
    assert cell.ready, cell.status.reason


async def let_the_cell_stand_still(cell: CellSupervisor) -> None:
    os.kill(process_of(cell), signal.SIGSTOP)
    while cell.ready:
        await asyncio.sleep(0.02)
    assert cell.status.reason == "its loop stood still for 2 s, so its process was ended"


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="stops processes")
@pytest.mark.parametrize("then", [let_the_machine_stand_still, let_the_cell_stand_still])
def test_a_cell_is_not_ended_because_the_machine_was_busy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, then: Callable[[CellSupervisor], Awaitable[None]]
) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(supervisor, "SILENCE_S", 2.0)
    monkeypatch.setattr(supervisor, "LOOK_S", 0.1)
    start(tmp_path, 0.0, lambda cell: cell.ready and cell.alive.rounds > 1, then)
