"""Plans are previewed for the world as it is, by processes that end; nothing is done."""

from __future__ import annotations

from typing import Any

import pytest

from server.running import RunningServer


def preview(server: RunningServer, **request: Any) -> Any:
    return server.client.post("/cells/yard/plans", json=request)


def test_a_plan_is_previewed_with_its_proof_and_nothing_is_done(server: RunningServer) -> None:
    server.put_back()
    before = server.client.get("/cells/yard/world").json()["sequence"]
    plan = preview(server, task="carry", arguments={"crate": "lab:crate-2", "to": "lab:Goal"}).json()
    assert [each["skill"] for each in plan["plan"]] == ["Load", "Unload"] and plan["status"] == "solved"
    assert plan["plan"][0]["arguments"]["crate"] == "lab:crate-2" and plan["plan"][0]["source"].startswith("yard.skill")
    assert plan["plan_optimal"] and "2 steps" in plan["text"] and plan["sequence"] == before
    scheduled = preview(server, goal="lab:Goal contain lab:crate-2", minimise="makespan").json()
    assert [each["start_s"] for each in scheduled["plan"]] == sorted(each["start_s"] for each in scheduled["plan"])
    assert server.client.get("/cells/yard/world").json()["sequence"] == before


def test_why_there_is_no_plan(server: RunningServer) -> None:
    answer = preview(server, goal="lab:Cart-1 contain lab:Goal").json()
    assert answer["status"] == "unsolvable" and answer["failure"] and answer["text"]


@pytest.mark.parametrize(
    ("request_", "said"),
    [
        ({"task": "fly"}, "fly"),
        ({"goal": "lab:Goal contain lab:crat-1"}, "lab:crate-1"),
        ({"goal": "("}, ""),
        ({}, "exactly one"),
        ({"task": "carry_two"}, "has a body, not a goal"),
        ({"task": "carry", "arguments": {"crate": "lab:crate-0"}}, "to"),
        ({"task": "carry_all", "minimise": "makespan", "prove": True}, "`prove`"),
        ({"task": "carry_all", "deadline_s": 1e9}, "deadline_s"),
    ],
)
def test_what_cannot_be_planned_for_is_refused_with_the_reason(
    server: RunningServer, request_: dict[str, Any], said: str
) -> None:
    answer = preview(server, **request_)
    assert answer.status_code == 422 and said in answer.json()["detail"], answer.text


def test_a_goal_that_costs_exponential_time_ends(server: RunningServer) -> None:
    variables = [f"c{number}" for number in range(9)]
    different = " and ".join(f"{a} != {b}" for a in variables for b in variables if a < b)
    quantified = "".join(f"exists {each}: skiros:Product (" for each in variables)
    goal = f"{quantified}lab:Goal contain c0 and {different}{')' * len(variables)}"
    answer = preview(server, goal=goal, deadline_s=2.0)
    assert answer.status_code in (200, 422, 503), answer.text
    if answer.status_code == 200:
        assert answer.json()["status"] in ("gave-up", "unsolvable")
