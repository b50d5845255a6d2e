"""Plans are previewed for the world as it is, by processes that end; nothing is done."""

from __future__ import annotations

from typing import Any

import pytest

from server.running import RunningServer


def preview(server: RunningServer, **request: Any) -> Any:
    """Return the plan of a job, and the job."""
    done = server.wait_for_job(server.begin("plan", **request)["id"])
    return done, server.find_outcome(done["id"])["plan"] if done["state"] == "ended" else None


def test_a_plan_is_previewed_with_its_proof_and_nothing_is_done(server: RunningServer) -> None:
    server.put_back()
    before = server.client.get("/cells/yard/world").json()["sequence"]
    _, plan = preview(server, task="carry", arguments={"crate": "lab:crate-2", "to": "lab:Goal"})
    assert [each["skill"] for each in plan["plan"]] == ["Load", "Unload"] and plan["status"] == "solved"
    assert plan["plan"][0]["arguments"]["crate"] == "lab:crate-2" and plan["plan"][0]["source"].startswith("yard.skill")
    assert plan["plan_optimal"] and "2 steps" in plan["text"] and plan["sequence"] == before
    _, scheduled = preview(server, goal="lab:Goal contain lab:crate-2", minimise="makespan")
    assert [each["start_s"] for each in scheduled["plan"]] == sorted(each["start_s"] for each in scheduled["plan"])
    assert server.client.get("/cells/yard/world").json()["sequence"] == before


def test_why_there_is_no_plan(server: RunningServer) -> None:
    _, answer = preview(server, goal="lab:Cart-1 contain lab:Goal")
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
    ],
)
def test_what_cannot_be_planned_for_is_refused_with_the_reason(
    server: RunningServer, request_: dict[str, Any], said: str
) -> None:
    job, _ = preview(server, **request_)
    assert job["state"] == "failed" and said in job["reason"] == job["problem"]["detail"]
    refused = server.client.get(f"/jobs/{job['id']}/result")
    assert refused.status_code == 409 and said in refused.json()["detail"]


@pytest.mark.parametrize(
    ("request_", "said"),
    [
        ({"kind": "plan", "task": "carry_all", "minimise": "makespan", "prove": True}, "`prove`"),
        ({"kind": "plan", "task": "carry_all", "deadline_s": 1e9}, "deadline_s"),
        ({"kind": "plan", "task": "carry_all", "why": "so"}, "why"),
        ({"kind": "flight"}, "flight"),
        ({}, "kind"),
    ],
)
def test_what_is_no_request_for_a_job_is_refused(server: RunningServer, request_: dict[str, Any], said: str) -> None:
    answer = server.client.post("/jobs", json=request_)
    assert answer.status_code == 422 and said in answer.json()["detail"], answer.text


def test_a_goal_that_costs_exponential_time_ends(server: RunningServer) -> None:
    variables = [f"c{number}" for number in range(9)]
    different = " and ".join(f"{a} != {b}" for a in variables for b in variables if a < b)
    quantified = "".join(f"exists {each}: skiros:Product (" for each in variables)
    goal = f"{quantified}lab:Goal contain c0 and {different}{')' * len(variables)}"
    job, plan = preview(server, goal=goal, deadline_s=2.0)
    assert job["state"] == "failed" or plan["status"] in ("gave-up", "unsolvable")
