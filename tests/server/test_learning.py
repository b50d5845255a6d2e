"""Parameters are learned from trials in the scene of a cell; the study outlives the server, and no text changes."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

import skillc
from server.running import RunningServer, serving, wait_until
from skillc.contract.job import Job
from skillc.services.library.files import SHIPPED
from skillc_ontology import catalogue

PRESS = {
    "task": "press_button",
    "spec": {
        "minimise": "simulated_time",
        "subject_to": "greatest_force <= 120 %",
        "parameters": "PressButton.pace",
        "candidates": 4,
        "trials": 1,
        "fresh": 1,
    },
}


def write_button(folder: Path, _takes_ms: int) -> None:
    shutil.copytree(SHIPPED / "contact", folder, dirs_exist_ok=True)
    shutil.copyfile(catalogue.scene_path("ur5e_button"), folder / "yard.ttl")


def look(server: RunningServer, job: str) -> Any:
    return server.client.get(f"/jobs/{job}").json()


@pytest.mark.sim
def test_learning_goes_on_after_the_server_was_killed(tmp_path: Path) -> None:
    text = (SHIPPED / "contact" / "press.skill").read_text("utf-8")
    with serving(tmp_path, write=write_button) as server:
        job = server.begin("learn", cell="yard", **PRESS)["id"]
        wait_until(lambda: look(server, job), lambda found: found["done"] > 0 or found["state"] == "failed")
        assert look(server, job)["state"] == "running", look(server, job)
        server.process.kill()
    with serving(tmp_path, write=write_button) as server:
        found = look(server, job)
        assert (found["state"], found["wanted"]) == ("interrupted", 4) and 0 < found["done"] < 4
        again = server.client.post(f"/jobs/{job}/restart").json()
        assert again["done"] == found["done"]
        ended = server.wait_for_job(job)
        assert (ended["state"], ended["reason"], ended["done"]) == ("ended", "", 4)
        assert {"learned.diff", "learned.html"} <= set(ended["files"])
        learned = server.find_outcome(job)
        assert learned["candidates"] == 4 and list(learned["values"]) == ["PressButton.by_force.pace"]
        before, after = learned["objectives"]["simulated_time"]
        assert after < before
        assert f"+    refine pace: Number = {next(iter(learned['values'].values()))}" in learned["diff"]
        assert (tmp_path / "press.skill").read_text("utf-8") == text
        page = server.client.get(f"/jobs/{job}/files/learned.html").text
        assert page.count("<circle") == 4


def test_what_cannot_be_learned_is_refused(server: RunningServer) -> None:
    asked = {"kind": "learn", "cell": "yard", "task": "carry_all"}
    for spec, said in (
        ({"minimise": "tim"}, "did you mean"),
        ({"minimise": "time", "apply": True}, "does not change the texts"),
        ({"minimise": "time", "candidates": 0}, "candidates"),
    ):
        answer = server.client.post("/jobs", json={**asked, "spec": spec})
        assert answer.status_code == 422 and said in answer.text
    answer = server.client.post("/jobs", json={**asked, "task": "carry_al", "spec": {"minimise": "time"}})
    assert answer.status_code == 422 and "did you mean `carry_all`" in answer.text


@pytest.mark.sim
def test_a_task_without_such_parameters_ends_with_the_reason(server: RunningServer) -> None:
    seen: list[Job] = []
    address = f"http://127.0.0.1:{server.port}"
    with (
        skillc.connect(address, state=server.folder / "served") as client,
        pytest.raises(skillc.RefusedError, match="range"),
    ):
        client.cell("yard").learn("carry_all", minimise="time", watch=seen.append)
    assert seen[-1].state == "failed"
