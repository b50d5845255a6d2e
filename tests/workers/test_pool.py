"""Jobs are done by processes that end when nobody waits for them, and by no more of them than there may be."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable, Coroutine
from functools import partial
from typing import Any

import pytest

from running_cells.yard import write_yard
from skillc.cells.snapshot import CellSnapshot, encode_snapshot
from skillc.contract.world import QueryRows
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.scene.stores import StoreChoice
from skillc.services.views.open_scenes import open_scene
from skillc.workers import pool
from skillc.workers.pool import TooMuchWork, Workers, WorkTimedOut
from skillc.workers.questions import query_world
from skillc_runtime.execution.worker_process import WorkerProcess
from waiting import LONG_S

ENDLESS = partial(
    query_world, f"SELECT * {{ {' . '.join(f'?a{n} ?b{n} ?c{n}' for n in range(9))} . FILTER(?c0 = ?c1 + 1) }}"
)
QUICK = partial(query_world, "ASK { ?s ?p ?o }")


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[WorkerProcess]:
    """The processes that are started."""
    found = list[WorkerProcess]()

    def start(*arguments: Any) -> WorkerProcess:
        found.append(WorkerProcess(*arguments))
        return found[-1]

    monkeypatch.setattr(pool, "WorkerProcess", start)
    return found


@pytest.fixture(scope="module")
def snapshot(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    folder = tmp_path_factory.mktemp("yard")
    write_yard(folder)
    with open_scene(folder / "yard.ttl", folder, StoreChoice(), False, SilentReporter()) as opened:
        return encode_snapshot(CellSnapshot(opened.library, opened.state, (), 0))


def busy(workers: Workers, snapshot: bytes) -> asyncio.Task[QueryRows]:
    return asyncio.create_task(workers.answer(ENDLESS, snapshot, QueryRows, LONG_S))


@pytest.mark.slow
def test_a_process_is_kept_until_nobody_waits_for_its_answer(snapshot: bytes, started: list[WorkerProcess]) -> None:
    async def leave(workers: Workers) -> None:
        for _ in range(2):
            assert (await workers.answer(QUICK, snapshot, QueryRows, LONG_S)).rows == ((True,),)
        assert len(started) == 1
        endless = busy(workers, snapshot)
        await asyncio.sleep(0.5)
        assert not endless.done()
        endless.cancel()
        await ended(started)
        assert (await workers.answer(QUICK, snapshot, QueryRows, LONG_S)).rows == ((True,),)
        assert len(started) == 2

    use(leave)


def test_a_server_that_ends_leaves_no_process(snapshot: bytes, started: list[WorkerProcess]) -> None:
    async def end(workers: Workers) -> None:
        endless = busy(workers, snapshot)
        await asyncio.sleep(0.5)
        workers.close()
        with pytest.raises(WorkTimedOut):
            await endless
        await ended(started)

    use(end)


def test_who_waits_too_long_for_a_process_is_refused(
    snapshot: bytes, started: list[WorkerProcess], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pool, "MAX_WAITING", 1)

    async def crowd(workers: Workers) -> None:
        endless = [busy(workers, snapshot) for _ in range(pool.MAX_WORKERS)]
        waiting = busy(workers, snapshot)
        await asyncio.sleep(0.0)  # each begins in its turn
        with pytest.raises(TooMuchWork, match="1 requests wait"):
            await busy(workers, snapshot)
        with pytest.raises(TooMuchWork, match=r"no process was free for 1 s"):
            await waiting
        workers.close()
        await asyncio.wait(endless)
        assert len(started) == pool.MAX_WORKERS

    use(crowd, turn_s=1.0)


def use(test: Callable[[Workers], Coroutine[None, None, None]], turn_s: float = pool.TURN_S) -> None:
    async def run() -> None:
        workers = Workers(turn_s=turn_s)
        try:
            await test(workers)
        finally:
            workers.close()

    asyncio.run(run())


async def ended(started: list[WorkerProcess]) -> None:
    async with asyncio.timeout(LONG_S):
        while is_alive(started[-1].pid):
            await asyncio.sleep(0.05)


def is_alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_a_process_that_cannot_be_started_is_said(snapshot: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: Any) -> WorkerProcess:
        raise OSError(11, "Resource temporarily unavailable")

    monkeypatch.setattr(pool, "WorkerProcess", refuse)

    async def ask(workers: Workers) -> None:
        with pytest.raises(TooMuchWork, match=r"no process can be started \(Resource temporarily unavailable\)"):
            await workers.answer(QUICK, snapshot, QueryRows, LONG_S)

    use(ask)
