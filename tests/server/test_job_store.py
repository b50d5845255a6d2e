"""What becomes of jobs, without a server: errors that nobody expected, requests that cross, and those that are old."""

from __future__ import annotations

import asyncio
import sqlite3
from collections.abc import Awaitable, Callable
from http import HTTPStatus
from pathlib import Path

import pytest
from msgspec import structs

from skillc.contract.job import Job, JobChanged, RunResult
from skillc.contract.plan import PlanRequest
from skillc.contract.rehearsal import RehearsalRequest
from skillc.server.jobs.running import Jobs, Lane, RunningJob
from skillc.server.jobs.store import JOB_EVENTS, JOBS, KEPT, JobStore
from skillc.server.problems import ApiRefusal
from skillc.workers.pool import Workers, WorkFailed

PLAN = Job(id="a", cell="yard", owner="ada", request=PlanRequest(goal="g"))


def open_store() -> JobStore:
    database = sqlite3.connect(":memory:", isolation_level=None)
    database.executescript(f"{JOBS};{JOB_EVENTS}")
    return JobStore(database)


def use(folder: Path, test: Callable[[Jobs, list[JobChanged]], Awaitable[None]]) -> None:
    async def run() -> None:
        heard = list[JobChanged]()
        jobs = Jobs(open_store(), folder, {"plans": Lane.of(Workers(count=1), 2)}, heard.append)
        await test(jobs, heard)
        await jobs.close()

    asyncio.run(run())


async def settle() -> None:
    for _ in range(10):
        await asyncio.sleep(0)


@pytest.mark.parametrize(
    ("error", "said"),
    [(KeyError("x"), "an error of skillc: KeyError('x')"), (WorkFailed("there is no crate"), "there is no crate")],
)
def test_a_job_that_raises_has_failed_and_can_be_begun_again(tmp_path: Path, error: Exception, said: str) -> None:
    async def run(_: RunningJob) -> RunResult:
        raise error

    async def test(jobs: Jobs, heard: list[JobChanged]) -> None:
        for _ in range(2):
            jobs.begin(PLAN, "plans", b"", run)
            await settle()
            failed = jobs.find("a")
            assert (failed.state, failed.reason) == ("failed", said) and failed.problem is not None
        assert [each.job.state for each in heard] == ["waiting", "running", "failed"] * 2
        assert [each.message for each in jobs.store.events("a", 3)] == ["waiting", "running", f"failed: {said}"]

    use(tmp_path, test)


def test_a_job_is_done_once_at_a_time_and_lanes_have_room_for_some(tmp_path: Path) -> None:
    async def run(_: RunningJob) -> None:
        await asyncio.sleep(60.0)

    async def test(jobs: Jobs, _: list[JobChanged]) -> None:
        jobs.begin(PLAN, "plans", b"", run)
        with pytest.raises(ApiRefusal, match="a goes on") as refused:
            jobs.begin(PLAN, "plans", b"", run)
        assert refused.value.status is HTTPStatus.CONFLICT
        jobs.check_room("plans")
        jobs.begin(structs.replace(PLAN, id="b"), "plans", b"", run)
        with pytest.raises(ApiRefusal, match="2 plans wait or go on"):
            jobs.check_room("plans")
        await settle()
        assert [each.state for each in jobs.store.list()] == ["running", "waiting"]
        jobs.cancel("a", "by ada")
        jobs.cancel("a", "by bob")
        await settle()
        assert [(each.state, each.reason) for each in jobs.store.list()] == [("cancelled", "by ada"), ("running", "")]
        jobs.remove("b")
        assert [each.id for each in jobs.store.list()] == ["a"] and jobs.store.events("b") == ()

    use(tmp_path, test)


def test_the_last_ones_of_each_kind_are_kept_with_their_files_and_those_that_go_on(tmp_path: Path) -> None:
    store = open_store()
    for number in range(KEPT + 3):
        state = "interrupted" if number == 1 else "running" if number == 2 else "ended"
        store.put(structs.replace(PLAN, id=f"plan {number}", state=state), state)
    rehearsal = Job(id="r", cell="hall", owner="ada", request=RehearsalRequest(goal="g"), state="ended", files=("f",))
    store.put(rehearsal, "ended")
    assert set(store.list_old()) == {"plan 0", "plan 1"}
    assert [each.id for each in store.list("hall")] == ["r"]
    for name in ("r", "plan 3", "unknown"):
        (tmp_path / name).mkdir()
    Jobs(store, tmp_path, {}, lambda _: None)
    assert [each.name for each in tmp_path.iterdir()] == ["r"]
