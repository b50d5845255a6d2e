"""The same request twice is one operation, also at the same time, and when cell or server die meanwhile."""

from __future__ import annotations

import asyncio
import os
import signal

import httpx

from server.running import RunningServer, find_cell_process
from waiting import LONG_S

CARRY = {"task": "carry", "arguments": {"crate": "lab:crate-1", "to": "lab:Goal"}, "approve": True}
KEY = {"Idempotency-Key": "once"}


def submit(server: RunningServer, key: dict[str, str] = KEY) -> httpx.Response:
    return server.client.post("/cells/yard/operations", json=CARRY, headers=key)


def test_requests_with_one_key_at_the_same_time_are_one_operation(server: RunningServer) -> None:
    async def submit_all() -> list[httpx.Response]:
        headers = {"Authorization": f"Bearer {server.token}", "Idempotency-Key": "together"}
        async with httpx.AsyncClient(base_url=server.url, headers=headers, timeout=LONG_S) as client:
            return await asyncio.gather(*(client.post("/cells/yard/operations", json=CARRY) for _ in range(8)))

    answers = asyncio.run(submit_all())
    assert {each.status_code for each in answers} == {201}
    (operation,) = {each.json()["id"] for each in answers}
    server.client.post(f"/operations/{operation}/stop", json={})


def test_a_key_whose_request_no_cell_has_taken_can_be_used_again(server: RunningServer) -> None:
    key, before = {"Idempotency-Key": "not taken"}, server.client.get("/cells/yard/operations").json()
    os.kill(find_cell_process(server), signal.SIGKILL)
    first = submit(server, key)
    server.wait_ready()
    second, third = submit(server, key), submit(server, key)
    assert second.status_code == third.status_code == 201, (first.text, second.text)
    assert second.json()["id"] == third.json()["id"]
    made = {each["id"] for each in server.client.get("/cells/yard/operations").json()} - {each["id"] for each in before}
    assert made == {second.json()["id"]}
    server.client.post(f"/operations/{second.json()['id']}/stop", json={})
