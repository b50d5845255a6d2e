"""A cell that starts slowly is waited for, and one that never is ready is ended."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest
from msgspec import structs

from running_cells.yard import write_yard
from skillc.server import supervisor
from skillc.server.supervisor import CellSupervisor

LIMIT_S = 120.0


def start(folder: Path, import_s: float, until: Callable[[CellSupervisor], bool]) -> CellSupervisor:
    """Keep a cell going whose library names a module that takes long to import, until a condition holds."""
    (folder / "slow_to_import.py").write_text(f"import time\ntime.sleep({import_s})\n", encoding="utf-8")
    cell = CellSupervisor(structs.replace(write_yard(folder), modules=("slow_to_import",)), lambda _: None)

    async def wait() -> None:
        going = asyncio.create_task(cell.keep_going())
        try:
            async with asyncio.timeout(LIMIT_S):
                while not until(cell):
                    await asyncio.sleep(0.02)
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
