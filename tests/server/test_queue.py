"""The operations that wait in a cell are listed in their order, which clients change."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest

from server.running import RunningServer, wait_until
from server.test_client_commands import here, type_in  # noqa: F401  a fixture
from server.test_leases import client_of


@pytest.fixture
def waiting(here: RunningServer) -> Iterator[list[str]]:  # noqa: F811
    """An operation that runs and stays where it is, and three that wait for it."""
    here.client.post("/cells/yard/reset")
    names = [here.submit(task="carry_all", step=True)["id"]]
    here.wait_for(names[0], "paused")
    names += [here.submit(call="Load(cart: lab:Cart-1, crate: lab:crate-2)")["id"] for _ in range(3)]
    for each in names[1:]:
        here.wait_for(each, "queued")
    yield names
    here.client.post("/cells/yard/stop")
    for each in names:
        here.wait_for(each, "stopped", "failed", "succeeded")


def listed(server: RunningServer) -> list[str]:
    return [each["id"] for each in server.client.get("/cells/yard/queue").json()]


def test_what_waits_is_put_first(here: RunningServer, waiting: list[str]) -> None:  # noqa: F811
    holder, first, second, third = waiting
    assert listed(here) == [first, second, third]
    with client_of(here, "ed", "operate") as ed:
        answer = ed.put("/cells/yard/queue", json={"first": [third]})
        assert [each["id"] for each in answer.json()] == [third, first, second], answer.text
    assert [each["place"] for each in here.client.get("/cells/yard/queue").json()] == [1, 2, 3]
    urgent = here.submit(call="Load(cart: lab:Cart-1, crate: lab:crate-3)", priority=3, approve=True)["id"]
    waiting.append(urgent)
    assert listed(here) == [urgent, third, first, second]
    here.client.put("/cells/yard/queue", json={"first": [second, first, second]})
    assert listed(here) == [second, first, urgent, third]
    refused = here.client.put("/cells/yard/queue", json={"first": [holder]})
    assert refused.status_code == 409
    assert f"{holder} does not wait in yard; there wait: {second}" in refused.json()["detail"]
    here.client.post(f"/operations/{holder}/stop")
    ended = here.wait_for(second, "succeeded", "failed")
    assert ended["state"] == "succeeded", "it got the cart, which the others do not find empty"


def test_the_queue_is_listed_and_changed_on_the_command_line(here: RunningServer, waiting: list[str]) -> None:  # noqa: F811
    _, first, second, third = waiting
    moved = type_in("queue", third, second)
    assert moved.exit_code == 0
    assert [line.split()[0] for line in moved.stdout.splitlines()] == [third, second, first]
    assert type_in("queue").stdout == moved.stdout
    found: list[dict[str, Any]] = json.loads(type_in("queue", "--json").stdout)
    assert [each["place"] for each in found] == [1, 2, 3]
    wrong = type_in("queue", "nothing")
    assert wrong.exit_code == 1 and "error: nothing does not wait in yard" in wrong.stderr
    type_in("stop")
    wait_until(lambda: type_in("queue"), lambda it: it.stdout == "")
