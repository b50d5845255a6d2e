"""What an operation would do is tried in a twin of the cell as it is known; the cell itself does nothing."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from server.running import RunningServer
from server.test_client_commands import here, type_in  # noqa: F401  a fixture
from skillc_runtime.recording.events import TaskEnded
from skillc_runtime.recording.mcap.reader import read_recording

GOAL = "lab:Goal contain lab:crate-2"


def rehearse(server: RunningServer, **request: Any) -> Any:
    done = server.wait_for_job(server.begin("rehearsal", **request)["id"])
    assert (done["state"], done["done"], done["reason"]) == ("ended", 1, "")
    return {**done, "result": server.find_outcome(done["id"])["run"]}


def test_a_goal_is_rehearsed_and_nothing_is_done(server: RunningServer) -> None:
    server.put_back()
    before = server.client.get("/cells/yard/world").json()
    done = rehearse(server, goal=GOAL)
    assert done["result"]["status"] == "succeeded" and done["files"] == []
    assert [(each["skill"], each["status"]) for each in done["result"]["plan"]] == [
        ("Load", "success"),
        ("Unload", "success"),
    ]
    assert done["result"]["sim_time_s"] == pytest.approx(0.4, abs=0.2)
    assert server.client.get("/cells/yard/world").json() == before
    assert done["id"] in [each["id"] for each in server.client.get("/jobs", params={"cell": "yard"}).json()]
    assert server.client.get(f"/jobs/{done['id']}/files/film.mp4").status_code == 404
    assert server.client.delete(f"/jobs/{done['id']}").status_code == 204
    assert server.client.get(f"/jobs/{done['id']}").status_code == 404


def test_a_rehearsal_is_recorded_to_be_played(server: RunningServer, tmp_path: Path) -> None:
    server.put_back()
    done = rehearse(server, goal=GOAL, record=True)
    assert done["files"] == ["recording.mcap"]
    answer = server.client.get(f"/jobs/{done['id']}/files/recording.mcap")
    (tmp_path / "twin.mcap").write_bytes(answer.content)
    recorded = read_recording(tmp_path / "twin.mcap")
    assert not recorded.note and isinstance(recorded.envelopes[-1].event, TaskEnded)
    without = rehearse(server, goal=GOAL)
    assert server.client.get(f"/jobs/{without['id']}/files/recording.mcap").status_code == 404


def test_what_cannot_be_rehearsed_is_refused_with_the_reason(server: RunningServer) -> None:
    for request, why in (({"task": "carry_al"}, "did you mean `carry_all`"), ({}, "exactly one")):
        refused = server.client.post("/jobs", json={"kind": "rehearsal", **request})
        assert refused.status_code == 422 and why in refused.json()["detail"]
    assert rehearse(server, goal="lab:Cart-1 contain lab:Goal")["result"]["status"] == "refused"
    assert server.client.post("/jobs", json={"kind": "rehearsal", "goal": GOAL, "seed": -1}).status_code == 422


def test_an_operation_that_goes_on_is_not_disturbed(server: RunningServer) -> None:
    server.put_back()
    operation = server.submit(goal=GOAL, approve=True)["id"]
    server.wait_for(operation, "planned")
    assert rehearse(server, goal=GOAL)["result"]["status"] == "succeeded"
    assert server.wait_for(operation, "planned")
    server.client.post(f"/operations/{operation}/stop", json={})


def test_a_rehearsal_is_shown_in_the_shell(here: RunningServer, tmp_path: Path) -> None:  # noqa: F811
    here.put_back()
    shown = type_in("rehearse", "--goal", GOAL)
    assert shown.exit_code == 0 and "Unload" in shown.stdout, shown.stderr
    told = json.loads(type_in("rehearse", "carry", "crate=lab:crate-2", "to=lab:Goal", "--json").stdout)
    assert told["status"] == "succeeded"
    assert type_in("rehearse", "--goal", GOAL, "--deadline", "0.1").exit_code == 3
    refused = type_in("rehearse", "carry_al", "--film", str(tmp_path / "film.mp4"))
    assert refused.exit_code == 1 and "did you mean `carry_all`" in refused.stderr
