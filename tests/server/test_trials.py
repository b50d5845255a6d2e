"""A task is run many times from the scene of a cell; the cell itself does nothing, and the results are kept."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from server.running import RunningServer, serving, wait_until
from server.test_client_commands import here, terminal_environment, type_in  # noqa: F401  a fixture
from skillc.api.trials import trials
from skillc.server.trials import running

CARRY = {"task": "carry", "arguments": {"crate": "lab:crate-1", "to": "lab:Goal"}}
ENDS = ("ended", "interrupted")
SLOW = """
class Stuck(Primitive):
    def tick(self) -> Status:
        time.sleep(1.0)
        return Status.RUNNING
"""


def post(server: RunningServer, cell: str = "yard", **request: Any) -> Any:
    answer = server.client.post(f"/cells/{cell}/trials", json={**CARRY, "number": 3, **request})
    assert answer.status_code == 202, answer.text
    return answer.json()


def wait_for(server: RunningServer, name: str, *states: str) -> Any:
    return wait_until(lambda: server.client.get(f"/trials/{name}").json(), lambda found: found["state"] in states)


def without_times(series: dict[str, Any]) -> dict[str, Any]:
    """Return a series without what differs from run to run."""
    return {**series, "mean_wall_time_s": None}


def test_trials_start_from_the_scene_and_the_cell_does_nothing(server: RunningServer) -> None:
    server.put_back()
    before = server.client.get("/cells/yard/world").json()
    begun = post(server, seed=5)
    done = wait_for(server, begun["id"], *ENDS)
    assert (done["state"], done["reason"], done["done"], done["passed"]) == ("ended", "", 3, 3)
    result = server.client.get(f"/trials/{begun['id']}/result").json()
    assert (result["task"], result["wanted"], result["passed"]) == ("carry(crate: lab:crate-1, to: lab:Goal)", 3, 3)
    assert [(each["seed"], each["status"]) for each in result["trials"]] == [(n, "succeeded") for n in (5, 6, 7)]
    assert server.client.get("/cells/yard/world").json() == before
    assert begun["id"] in [each["id"] for each in server.client.get("/cells/yard/trials").json()]
    assert server.client.delete(f"/trials/{begun['id']}").status_code == 204
    assert server.client.get(f"/trials/{begun['id']}").status_code == 404


@pytest.mark.parametrize(
    ("request_", "status", "said"),
    [
        ({"task": "carry_al"}, 422, "did you mean `carry_all`"),
        ({"task": "carry"}, 422, "crate"),
        ({"task": "carry_all", "arguments": {"crate": "lab:crate-1"}}, 422, "takes no arguments"),
        ({"task": "carry_all", "number": 0}, 422, "number"),
        ({"task": "carry_all", "disturb": "rain"}, 422, "disturb"),
        ({"task": "carry_all", "scene": "other.ttl"}, 422, "scene"),
    ],
)
def test_trials_that_cannot_be_run_are_refused(
    server: RunningServer, request_: dict[str, Any], status: int, said: str
) -> None:
    before = server.client.get("/cells/yard/trials").json()
    answer = server.client.post("/cells/yard/trials", json=request_)
    assert answer.status_code == status and said in answer.text
    assert server.client.get("/cells/yard/trials").json() == before


def test_only_so_many_series_wait_and_one_that_is_removed_ends(server: RunningServer) -> None:
    begun = [post(server, number=1000) for _ in range(running.MAX_UNFINISHED)]
    first, second = begun[0]["id"], begun[1]["id"]
    wait_until(lambda: server.client.get(f"/trials/{first}").json(), lambda found: found["done"] > 0)
    assert server.client.get(f"/trials/{second}").json()["state"] == "waiting"
    assert server.client.post("/cells/yard/trials", json=CARRY).status_code == 429
    operation = server.submit(goal="lab:Goal contain lab:crate-2")["id"]
    assert server.wait_for(operation, "succeeded"), "the cell goes on"
    for each in begun[2:]:
        assert server.client.delete(f"/trials/{each['id']}").status_code == 204
    assert server.client.delete(f"/trials/{first}").status_code == 204
    wait_for(server, second, "going on")
    assert server.client.delete(f"/trials/{second}").status_code == 204
    wait_for(server, post(server, number=1)["id"], "ended")


def test_trials_are_run_from_the_shell(here: RunningServer) -> None:  # noqa: F811
    words = ("trials", "carry", "crate=lab:crate-1", "to=lab:Goal", "--cell", "yard", "-n", "2")
    shown = type_in(*words)
    assert shown.exit_code == 0 and "2 of 2" in shown.stdout, shown.output
    told = json.loads(type_in(*words, "--seed", "3", "--json").stdout)
    assert [each["seed"] for each in told["trials"]] == [3, 4]
    assert type_in(*words, "--jobs", "2").exit_code == 2
    refused = type_in("trials", "carry_al", "--cell", "yard")
    assert refused.exit_code == 1 and "did you mean `carry_all`" in refused.stderr


def test_who_no_longer_waits_for_trials_ends_them(here: RunningServer) -> None:  # noqa: F811
    before = {each["id"] for each in here.client.get("/cells/yard/trials").json()}
    words = ("trials", "carry_all", "--cell", "yard", "-n", "1000")
    shell = subprocess.Popen((sys.executable, "-m", "skillc", *words), env=terminal_environment())
    wait_until(
        lambda: [each["done"] for each in here.client.get("/cells/yard/trials").json() if each["id"] not in before],
        lambda done: any(done),
    )
    shell.send_signal(signal.SIGINT)
    assert shell.wait(30.0) == 130
    assert {each["id"] for each in here.client.get("/cells/yard/trials").json()} <= before


@pytest.mark.sim
def test_a_server_gets_the_same_figures_as_trials_without_one(tmp_path: Path) -> None:
    with serving(tmp_path) as server:
        begun = post(server, task="carry_all", arguments={}, number=2, seed=3)
        wait_for(server, begun["id"], *ENDS)
        served = server.client.get(f"/trials/{begun['id']}/result").json()
    local = json.loads(json.dumps(trials(f"{tmp_path}:carry_all", 2, seed=3).to_dict()))
    assert served["passed"] == 2 and without_times(served) == without_times(local)


def test_a_trial_is_run_again_as_it_was_and_recorded(server: RunningServer) -> None:
    begun = post(server, seed=5)
    wait_for(server, begun["id"], *ENDS)
    result = server.client.get(f"/trials/{begun['id']}/result").json()
    assert all(each["seeds"] == [5, 6, 7] and len(each["values"]) == 3 for each in result["spreads"])
    path = f"/trials/{begun['id']}/replays/6"
    assert server.client.get(path).status_code == 404
    assert server.client.post(path).status_code == 201
    replay = wait_until(lambda: server.client.get(path).json(), lambda found: found["state"] == "ended")
    assert replay["recording"] and replay["reason"] == ""
    trial = next(each for each in result["trials"] if each["seed"] == 6)
    assert (replay["result"]["seed"], replay["result"]["sim_time_s"]) == (6, trial["sim_time_s"])
    assert server.client.get(f"{path}/recording").content.startswith(b"\x89MCAP")
    assert server.client.post(path).json() == replay


def test_a_trial_that_a_series_does_not_have_is_not_run(server: RunningServer) -> None:
    begun = post(server, seed=5)
    for seed in ("8", "4", "-1", "six", "9" * 40):
        assert server.client.post(f"/trials/{begun['id']}/replays/{seed}").status_code == 404, seed
    server.client.delete(f"/trials/{begun['id']}")
