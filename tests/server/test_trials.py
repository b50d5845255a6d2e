"""A task is run many times from the scene of a cell; the cell itself does nothing, and the results are kept."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from typing import Any

import pytest

from server.running import RunningServer, wait_until
from server.test_client_commands import here, terminal_environment, type_in  # noqa: F401  a fixture
from skillc.api.trials import trials
from skillc.server.context import MAX_SIMULATIONS
from waiting import LONG_S

CARRY = {"task": "carry", "arguments": {"crate": "lab:crate-1", "to": "lab:Goal"}}
SLOW = """
class Stuck(Primitive):
    def tick(self) -> Status:
        time.sleep(1.0)
        return Status.RUNNING
"""


def post(server: RunningServer, cell: str = "yard", **request: Any) -> Any:
    return server.begin("trials", **{**CARRY, "cell": cell, "number": 3, **request})


def list_trials(server: RunningServer) -> list[Any]:
    return [each for each in server.client.get("/jobs").json() if each["request"]["kind"] == "trials"]


def without_times(series: dict[str, Any]) -> dict[str, Any]:
    """Return a series without what differs from run to run."""
    return {**series, "mean_wall_time_s": None}


def test_trials_start_from_the_scene_and_the_cell_does_nothing(server: RunningServer) -> None:
    server.put_back()
    before = server.client.get("/cells/yard/world").json()
    begun = post(server, seed=5)
    done = server.wait_for_job(begun["id"])
    assert (done["state"], done["reason"], done["done"], done["failed"], done["wanted"]) == ("ended", "", 3, 0, 3)
    result = server.find_outcome(begun["id"])["series"]
    assert (result["task"], result["wanted"], result["passed"]) == ("carry(crate: lab:crate-1, to: lab:Goal)", 3, 3)
    assert [(each["seed"], each["status"]) for each in result["trials"]] == [(n, "succeeded") for n in (5, 6, 7)]
    assert server.client.get("/cells/yard/world").json() == before
    assert begun["id"] in [each["id"] for each in list_trials(server)]
    log = server.client.get(f"/jobs/{begun['id']}/events").json()
    assert [each["sequence"] for each in log] == [1, 2, 3, 4, 5, 6]
    assert [each["done"] for each in log] == [0, 0, 1, 2, 3, 3] and log[2]["message"] == "seed 5: passed"
    assert server.client.get(f"/jobs/{begun['id']}/events", params={"after": 5}).json() == log[5:]
    assert server.client.delete(f"/jobs/{begun['id']}").status_code == 204
    assert server.client.get(f"/jobs/{begun['id']}").status_code == 404


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
    before = list_trials(server)
    answer = server.client.post("/jobs", json={"kind": "trials", **request_})
    assert answer.status_code == status and said in answer.text
    assert list_trials(server) == before


def test_only_so_many_series_wait_and_one_that_is_removed_ends(server: RunningServer) -> None:
    begun = [post(server, number=1000) for _ in range(MAX_SIMULATIONS)]
    first, second = begun[0]["id"], begun[1]["id"]
    wait_until(lambda: server.client.get(f"/jobs/{first}").json(), lambda found: found["done"] > 0)
    assert server.client.get(f"/jobs/{second}").json()["state"] == "waiting"
    assert server.client.post("/jobs", json={"kind": "trials", **CARRY}).status_code == 429
    operation = server.submit(goal="lab:Goal contain lab:crate-2")["id"]
    assert server.wait_for(operation, "succeeded"), "the cell goes on"
    for each in begun[2:]:
        assert server.client.delete(f"/jobs/{each['id']}").status_code == 204
    assert server.client.delete(f"/jobs/{first}").status_code == 204
    server.wait_for_job(second, "running")
    cancelled = server.client.post(f"/jobs/{second}/cancel").json()
    assert (cancelled["state"], cancelled["reason"]) == ("cancelled", "by admin")
    server.wait_for_job(post(server, number=1)["id"], "ended")
    assert server.client.delete(f"/jobs/{second}").status_code == 204


def test_trials_that_were_cancelled_go_on_with_those_that_are_missing(server: RunningServer) -> None:
    begun = post(server, number=6, seed=40)["id"]
    wait_until(lambda: server.client.get(f"/jobs/{begun}").json(), lambda found: found["done"] > 0)
    cancelled = server.client.post(f"/jobs/{begun}/cancel").json()
    assert 0 < cancelled["done"] == len(server.find_outcome(begun)["series"]["trials"]) < 6
    again = server.client.post(f"/jobs/{begun}/restart").json()
    assert (again["state"], again["done"]) == ("waiting", cancelled["done"])
    assert server.wait_for_job(begun)["state"] == "ended"
    assert [each["seed"] for each in server.find_outcome(begun)["series"]["trials"]] == [*range(40, 46)]
    assert server.client.post(f"/jobs/{begun}/restart").status_code == 409


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
    before = {each["id"] for each in list_trials(here)}
    words = ("trials", "carry_all", "--cell", "yard", "-n", "1000")
    shell = subprocess.Popen((sys.executable, "-m", "skillc", *words), env=terminal_environment())
    wait_until(lambda: [each["done"] for each in list_trials(here) if each["id"] not in before], lambda done: any(done))
    shell.send_signal(signal.SIGINT)
    assert shell.wait(LONG_S) == 130
    assert [each["state"] for each in list_trials(here) if each["id"] not in before] == ["cancelled"]


@pytest.mark.sim
def test_a_server_gets_the_same_figures_as_trials_without_one(server: RunningServer) -> None:
    begun = post(server, task="carry_all", arguments={}, number=2, seed=3)
    server.wait_for_job(begun["id"])
    served = server.find_outcome(begun["id"])["series"]
    local = json.loads(json.dumps(trials(f"{server.folder}:carry_all", 2, seed=3).to_dict()))
    assert served["passed"] == 2 and without_times(served) == without_times(local)


def test_a_trial_is_run_again_as_it_was_and_recorded(server: RunningServer) -> None:
    begun = post(server, seed=5)
    server.wait_for_job(begun["id"])
    result = server.find_outcome(begun["id"])["series"]
    assert all(each["seeds"] == [5, 6, 7] and len(each["values"]) == 3 for each in result["spreads"])
    replay = server.wait_for_job(server.begin("trial-replay", trials=begun["id"], seed=6)["id"])
    assert (replay["state"], replay["files"], replay["cell"]) == ("ended", ["recording.mcap"], "yard")
    run = server.find_outcome(replay["id"])["run"]
    trial = next(each for each in result["trials"] if each["seed"] == 6)
    assert (run["seed"], run["sim_time_s"]) == (6, trial["sim_time_s"])
    assert server.client.get(f"/jobs/{replay['id']}/files/recording.mcap").content.startswith(b"\x89MCAP")


def test_a_trial_that_a_series_does_not_have_is_not_run(server: RunningServer) -> None:
    begun = post(server, seed=5)
    for seed, status in ((8, 409), (4, 409), (-1, 409), ("six", 422)):
        request = {"kind": "trial-replay", "trials": begun["id"], "seed": seed}
        assert server.client.post("/jobs", json=request).status_code == status, seed
    server.client.delete(f"/jobs/{begun['id']}")
    gone = server.client.post("/jobs", json={"kind": "trial-replay", "trials": begun["id"], "seed": 5})
    assert gone.status_code == 404
