"""Jobs of all kinds are shown, cancelled, begun again and removed in one way; who may not have one done is refused."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Iterator
from typing import Any

import httpx
import pytest

import skillc
from server.running import RunningServer
from server.test_client_commands import here, type_in  # noqa: F401  a fixture
from server.test_leases import client_of

GOAL = "lab:Goal contain lab:crate-2"
LONG = {"task": "carry_all", "number": 1000}


@pytest.fixture
def long(here: RunningServer) -> Iterator[Any]:  # noqa: F811
    """Trials that go on for long."""
    begun = here.begin("trials", **LONG)
    yield begun
    here.client.delete(f"/jobs/{begun['id']}")


def test_a_plan_is_for_those_who_see_and_all_else_for_those_who_operate(server: RunningServer) -> None:
    with client_of(server, "vera", "view") as vera:
        begun = vera.post("/jobs", json={"kind": "plan", "goal": GOAL})
        assert begun.status_code == 201 and begun.json()["owner"] == "vera"
        assert server.wait_for_job(begun.json()["id"])["state"] == "ended"
        refused = vera.post("/jobs", json={"kind": "rehearsal", "goal": GOAL})
        assert refused.status_code == 403 and "needs the role `operate`" in refused.json()["detail"]
        of_another = server.begin("plan", goal=GOAL)["id"]
        assert vera.delete(f"/jobs/{of_another}").status_code == 403
        trials = server.begin("trials", **LONG)["id"]
        for method, path in (("POST", f"{trials}/cancel"), ("DELETE", trials)):
            assert vera.request(method, f"/jobs/{path}").status_code == 403
        assert vera.delete(f"/jobs/{begun.json()['id']}").status_code == 204
    assert server.client.delete(f"/jobs/{trials}").status_code == 204


def test_a_job_that_is_none_is_not_found_whatever_is_asked(server: RunningServer) -> None:
    paths = ("", "/result", "/events", "/files/recording.mcap")
    assert [server.client.get(f"/jobs/none{each}").status_code for each in paths] == [404] * 4
    assert [server.client.post(f"/jobs/none/{each}").status_code for each in ("cancel", "restart")] == [404] * 2
    assert server.client.delete("/jobs/none").status_code == 404
    assert server.client.get("/jobs", params={"cell": "none"}).status_code == 404
    assert server.client.post("/jobs", json={"kind": "plan", "cell": "none", "goal": GOAL}).status_code == 404
    assert server.client.post("/jobs", json={"kind": "report", "operation": "none"}).status_code == 404


def test_the_next_line_of_a_log_is_waited_for(server: RunningServer) -> None:
    begun, after, lines = server.begin("rehearsal", goal=GOAL)["id"], 0, list[str]()
    while lines[-1:] != ["ended"]:
        for each in server.client.get(f"/jobs/{begun}/events", params={"after": after, "wait_s": 20}).json():
            lines.append(each["message"])
            after = each["sequence"]
    assert lines == ["waiting", "running", "ended"] and server.wait_for_job(begun)["state"] == "ended"
    assert server.client.get(f"/jobs/{begun}/events", params={"after": after, "wait_s": 20}).json() == []


def test_a_program_that_is_cancelled_cancels_its_job(server: RunningServer) -> None:
    async def give_up() -> None:
        url = server.url.removesuffix("/api/v1")
        async with skillc.connect_async(url, server.token) as connected:
            cell = await connected.cell("yard")
            begun = asyncio.Event()
            trials = asyncio.create_task(cell.trials("carry_all", 1000, watch=lambda _: begun.set()))
            await begun.wait()
            trials.cancel()
            with pytest.raises(asyncio.CancelledError):
                await trials

    asyncio.run(give_up())
    last = [each for each in server.client.get("/jobs").json() if each["request"]["kind"] == "trials"][-1]
    assert (last["state"], last["reason"]) == ("cancelled", "by admin")


def test_the_shell_shows_a_job_and_its_log_and_cancels_and_removes_it(here: RunningServer, long: Any) -> None:  # noqa: F811
    name = long["id"]
    listed = next(each for each in type_in("jobs", "list").stdout.splitlines() if each.startswith(name))
    assert listed.split()[1:4] == ["trials", "yard", "admin"] and "of 1000" in listed
    assert type_in("jobs", "cancel", name).stderr == f"{name}: cancelled\n"
    shown = json.loads(type_in("jobs", "show", name, "--json").stdout)
    assert (shown["job"]["state"], shown["job"]["reason"]) == ("cancelled", "by admin")
    logged = type_in("jobs", "log", name, "--follow").stdout.splitlines()
    assert logged[0].endswith("waiting") and logged[-1].endswith("cancelled by admin")
    assert type_in("jobs", "restart", name).stderr == f"{name}: waiting\n"
    assert type_in("jobs", "remove", name).exit_code == 0
    gone = type_in("jobs", "show", name)
    assert gone.exit_code == 1 and f"there is no job `{name}`" in gone.stderr


def test_the_shell_prints_what_came_of_a_job(here: RunningServer) -> None:  # noqa: F811
    here.put_back()
    plan, rehearsal = (here.begin(kind, goal=GOAL)["id"] for kind in ("plan", "rehearsal"))
    assert {here.wait_for_job(each)["state"] for each in (plan, rehearsal)} == {"ended"}
    assert "2 steps" in type_in("jobs", "show", plan).stdout
    assert "Unload" in type_in("jobs", "show", rehearsal).stdout


def test_each_change_of_a_job_is_news(server: RunningServer) -> None:
    from websockets.sync.client import connect

    with connect(f"ws{server.url.removeprefix('http')}/events") as socket:
        socket.send(json.dumps({"token": server.token}))
        begun, states = server.begin("plan", goal=GOAL)["id"], list[str]()
        while "ended" not in states:
            news = [each for each in json.loads(socket.recv(60.0)) if each["type"] == "job"]
            states += [each["job"]["state"] for each in news if each["job"]["id"] == begun]
        assert httpx.codes.is_success(server.client.delete(f"/jobs/{begun}").status_code)
        while not (news := [each for each in json.loads(socket.recv(60.0)) if each.get("removed")]):
            pass
        assert news[-1]["job"]["id"] == begun
