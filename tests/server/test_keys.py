"""The same request twice is one operation, also at the same time, and when cell or server die meanwhile."""

from __future__ import annotations

import asyncio
import os
import signal
import sqlite3
from contextlib import closing
from pathlib import Path

import httpx

from server.running import RunningServer, serving, wait_until

CARRY = {"task": "carry", "arguments": {"crate": "lab:crate-1", "to": "lab:Goal"}, "approve": True}
KEY = {"Idempotency-Key": "once"}


def submit(server: RunningServer, key: dict[str, str] = KEY) -> httpx.Response:
    return server.client.post("/cells/yard/operations", json=CARRY, headers=key)


def test_requests_with_one_key_at_the_same_time_are_one_operation(server: RunningServer) -> None:
    async def submit_all() -> list[httpx.Response]:
        headers = {"Authorization": f"Bearer {server.token}", "Idempotency-Key": "together"}
        async with httpx.AsyncClient(base_url=server.url, headers=headers, timeout=60.0) as client:
            return await asyncio.gather(*(client.post("/cells/yard/operations", json=CARRY) for _ in range(8)))

    answers = asyncio.run(submit_all())
    assert {each.status_code for each in answers} == {201}
    (operation,) = {each.json()["id"] for each in answers}
    server.client.post(f"/operations/{operation}/stop", json={})


def test_a_key_whose_request_no_cell_has_taken_can_be_used_again(tmp_path: Path) -> None:
    with serving(tmp_path) as server:
        os.kill(cell_of(server), signal.SIGKILL)
        first = submit(server)
        server.wait_ready()
        second, third = submit(server), submit(server)
        assert second.status_code == third.status_code == 201, (first.text, second.text)
        assert second.json()["id"] == third.json()["id"]
        assert len(server.client.get("/cells/yard/operations").json()) == 1


def test_a_server_that_dies_after_it_has_noted_a_key_submits_once_later(tmp_path: Path) -> None:
    with serving(tmp_path) as server:
        assert submit(server).status_code == 201
        before = server.client.get("/cells/yard/operations").json()
        server.process.send_signal(signal.SIGKILL)
        server.process.wait(30.0)
    with closing(sqlite3.connect(tmp_path / "served/server.sqlite")) as database, database:
        database.execute("UPDATE requests SET operation = 'carry-never-heard-of'")
    with serving(tmp_path) as server:
        again = [submit(server).json()["id"] for _ in range(2)]
        found = [each["id"] for each in server.client.get("/cells/yard/operations").json()]
    assert again == ["carry-never-heard-of"] * 2 and found == ["carry-never-heard-of", *(each["id"] for each in before)]


def cell_of(server: RunningServer) -> int:
    """Return the process of the cell."""
    children = Path(f"/proc/{server.process.pid}/task/{server.process.pid}/children")

    def find() -> list[int]:
        found = [int(each) for each in children.read_text().split()]
        return [each for each in found if b"cells.process" in Path(f"/proc/{each}/cmdline").read_bytes()]

    return int(wait_until(find, bool)[0])
