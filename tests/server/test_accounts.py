"""Operations say when they were submitted, started and ended, what they returned, and why they failed, as data."""

from __future__ import annotations

import json
from datetime import datetime
from typing import Any

import pytest

import skillc
from server.running import RunningServer, wait_until
from server.test_client_commands import type_in
from waiting import LONG_S

ASK = 'Ask(text: "Is it there?", choices: "yes | no", limit: 600 s)'


def ask(server: RunningServer, **request: Any) -> str:
    """Submit what asks, and return its id once it does."""
    operation = str(server.submit(**request)["id"])
    wait_until(lambda: server.client.get(f"/operations/{operation}").json(), lambda it: bool(it["prompts"]))
    return operation


def times(operation: dict[str, Any]) -> list[datetime | None]:
    names = ("submitted_at", "started_at", "ended_at")
    return [None if operation[each] is None else datetime.fromisoformat(operation[each]) for each in names]


def test_times_and_outputs_are_known_to_programs(server: RunningServer) -> None:
    operation = ask(server, call=ASK)
    submitted, started, ended = times(server.client.get(f"/operations/{operation}").json())
    assert submitted is not None and started is not None and submitted <= started and ended is None
    with skillc.connect(f"http://127.0.0.1:{server.port}", server.token) as connected:
        asking = connected.operation(operation)
        asking.answer("yes")
        end = asking.wait(LONG_S)
    assert [(each.skill, each.name, each.value) for each in end.outputs] == [("Ask", "answer", "yes")]
    assert end.started_at == started and end.ended_at is not None and end.ended_at >= started
    listed = server.client.get("/cells/yard/operations", params={"limit": 1}).json()[0]
    assert times(listed) == [submitted, started, end.ended_at], "the journal has the same"
    assert listed["outputs"] == server.client.get(f"/operations/{operation}").json()["outputs"]


def test_a_failure_is_data_also_while_somebody_has_to_decide(
    server: RunningServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SKILLC_SERVER", f"http://127.0.0.1:{server.port}")
    monkeypatch.setenv("SKILLC_TOKEN", server.token)
    operation = ask(server, task="confirm", ask_after_failure=True)
    server.client.post(f"/operations/{operation}/commands", json={"type": "answer", "choice": "no"})
    paused = server.wait_for(operation, "paused")
    assert paused["failure"]["source"]["path"].endswith("confirm.skill") and paused["failure"]["skill"] == "Confirm"
    (listed,) = [each for each in json.loads(type_in("ps", "--json").stdout)["operations"] if each["id"] == operation]
    assert listed["failure"] == paused["failure"] and listed["ended_at"] is None
    events = [json.loads(each)["event"] for each in type_in("logs", operation, "--json").stdout.splitlines()]
    (waits,) = [each for each in events if each.get("state") == "paused"]
    assert waits["failure"] == paused["failure"]
    server.client.post(f"/operations/{operation}/commands", json={"type": "retry"})
    wait_until(lambda: server.client.get(f"/operations/{operation}").json(), lambda it: bool(it["prompts"]))
    assert server.client.get(f"/operations/{operation}").json()["failure"] is None, "nobody has to decide any more"
    server.client.post(f"/operations/{operation}/stop", json={})
    assert server.wait_for(operation, "stopped")["failure"]["kind"] == "halted"
