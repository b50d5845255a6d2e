"""The commands that are clients of a server do what they say, say what is refused, and end with the right code."""

from __future__ import annotations

import json
import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.shell_completion import ShellComplete
from click.testing import CliRunner, Result

from operating.terminal import Terminal
from server.running import RunningServer, wait_until
from server.test_leases import client_of
from skillc.cli.main import skillc


@pytest.fixture
def here(server: RunningServer, monkeypatch: pytest.MonkeyPatch) -> Iterator[RunningServer]:
    """A shell that knows the server; nothing goes on afterwards."""
    monkeypatch.setenv("SKILLC_SERVER", f"http://127.0.0.1:{server.port}")
    monkeypatch.setenv("SKILLC_TOKEN", server.token)
    server.client.put("/cells/yard/pace", json={"factor": 1.0})
    yield server
    assert type_in("stop", "--all").exit_code == 0


def terminal_environment() -> dict[str, str]:
    """Return the environment of a program in a terminal that has a display, and knows the server."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "CI": ""}


def type_in(*words: str) -> Result:
    return CliRunner().invoke(skillc, list(words))


def test_a_task_is_planned_approved_paused_stepped_and_stopped(here: RunningServer) -> None:
    here.put_back(pace=0.1)
    started = type_in("start", "carry_all", "--approve", "--priority", "2")
    name = started.stdout.strip()
    here.wait_for(name, "planned")
    listed = json.loads(type_in("ps", "--json").stdout)
    assert [each["state"] for each in listed["operations"]] == ["planned"]
    assert listed["operations"][0]["request"]["priority"] == 2
    approved = type_in("approve", name)
    assert approved.exit_code == 0 and approved.stderr.startswith((f"{name}: queued", f"{name}: running"))
    here.wait_for(name, "running")
    assert type_in("pause", "--why", "a look").stderr == f"{name}: paused: a look\n"
    refused = type_in("approve")
    assert (refused.exit_code, refused.stdout) == (1, "")
    assert "error: `approve` is not possible while the task is paused; it allows resume" in refused.stderr
    assert f"{name}: paused: step: " in type_in("step", "over").stderr
    logged = type_in("logs", name).stdout.splitlines()
    assert [int(each.split()[0]) for each in logged] == sorted(int(each.split()[0]) for each in logged)
    assert any("plan: Load -> Unload -> Load" in each for each in logged) and logged[-1].endswith("next")
    assert f"{name}  yard  carry_all  admin  paused: step: " in type_in("ps").stdout
    assert type_in("resume").exit_code == 0
    stopped = type_in("stop", "--why", "enough")
    assert (stopped.exit_code, stopped.stderr) == (0, f"{name}: stopped: admin: enough\n")
    events = [json.loads(line) for line in type_in("logs", "-f", name, "--json", "--after", "2").stdout.splitlines()]
    assert [each["sequence"] for each in events] == list(range(3, len(events) + 3))
    assert events[-1]["event"]["type"] == "task-ended"


def test_stop_means_all_that_goes_on_whoever_started_it(here: RunningServer) -> None:
    first = here.submit(task="carry_all", approve=True)["id"]
    with client_of(here, "ada", "operate") as ada:
        second = ada.post("/cells/yard/operations", json={"task": "carry_all", "approve": True}).json()["id"]
    here.wait_for(first, "planned")
    stopped = type_in("stop", "--why", "too many")
    assert stopped.exit_code == 0
    assert sorted(stopped.stderr.splitlines()) == sorted(
        f"{each}: stopped: admin: too many" for each in (first, second)
    )
    again = type_in("stop", "--cell", "yard")
    assert (again.exit_code, again.stderr) == (0, "nothing goes on\n")


def test_the_exit_code_says_how_a_task_ended(here: RunningServer) -> None:
    assert type_in("pace", "fast").stderr == "yard: pace fast\n"
    stepped = type_in("start", "--goal", "lab:Goal contain lab:crate-4", "--approve").stdout.strip()
    assert type_in("wait").stderr == f"{stepped}: planned: waits for approval\n"
    assert type_in("stop").exit_code == 0 and type_in("wait", stepped).exit_code == 3
    waited = type_in("start", "--goal", "lab:Goal contain lab:crate-4", "--wait")
    assert waited.exit_code == 0 and "finished, not verified" in waited.stderr
    attached = type_in("start", "--goal", "lab:Start contain lab:crate-4", "--deadline", "0.1", "--attach")
    assert attached.exit_code == 3 and "failed" in attached.stderr


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (("pause",), 2, "no operation goes on"),
        (("stop", "nothing"), 1, "there is no operation `nothing`"),
        (("start", "carry_al"), 1, "did you mean `carry_all`"),
        (("start", "carry_all", "--cell", "barn"), 2, "there is no cell `barn`; the server has yard"),
        (("start",), 2, "exactly one of a task, a goal and a skill call"),
        (("acknowledge",), 1, "yard has no fault and no stop"),
        (("ps", "--server", "http://127.0.0.1:1"), 1, "start one with `skillc serve`"),
        (("ps", "--token-file", "none"), 2, "none has no token that this user can read"),
        (("ps", "--server", "http://example.org"), 2, "would get a token in the clear"),
        (("stop", "one", "--all"), 2, "give an operation, or --all or --cell"),
        (("stop", "one", "--cell", "yard"), 2, "give an operation, or --all or --cell"),
        (("stop", "--cell", "barn"), 2, "there is no cell `barn`"),
        (("step", "sideways"), 2, "not one of 'into', 'over', 'out'"),
        (("pace", "slow"), 2, "`slow` is no pace; write `fast`, `real`"),
        (("skip",), 2, "missing option '--why'"),
        (("token", "add", "a b", "--role", "view"), 1, "a name has letters, digits,"),
        (("plan", "carry_al", "--cell", "yard"), 1, "did you mean `carry_all`"),
        (("plan", "carry_all", "--cell", "yard", "--scene", "other.ttl"), 2, "--scene cannot be used with a cell"),
        (("world", "--cell", "barn"), 2, "there is no cell `barn`"),
        (("world", "yard.ttl", "--cell", "yard"), 2, "SCENE cannot be named with a cell of a server"),
        (("world", "--cell", "yard", "--show", "lab:crat-1"), 1, "did you mean lab:crate-1"),
        (("world", "--cell", "yard", "--query", "SELECT"), 1, "line 1, column 7"),
        (("world", "--cell", "yard", "--history", "--query", "ASK {}"), 2, "--export and --history cannot be combined"),
        (("world", "--history"), 2, "--history requires --cell or --server"),
        (("scene", "edit", "--cell", "yard", "lab:Goal skiros:contain lab:crate-1"), 2, "--why"),
        (
            ("scene", "edit", "--cell", "yard", "--why", "x", "lab:Goal skiros:contain"),
            1,
            "`lab:Goal skiros:contain`: ",
        ),
        (("scene", "edit", "lab:Goal skiros:contain lab:crate-1"), 2, "name SCENE"),
    ],
)
def test_what_cannot_be_done_is_refused(here: RunningServer, words: tuple[str, ...], code: int, said: str) -> None:
    done = type_in(*words)
    assert (done.exit_code, done.stdout) == (code, ""), done.stderr
    assert said in " ".join(done.stderr.split())


def test_a_plan_is_shown_for_the_world_of_a_cell(here: RunningServer) -> None:
    here.put_back()
    shown = type_in("plan", "carry", "crate=lab:crate-2", "to=lab:Goal", "--cell", "yard")
    assert shown.exit_code == 0 and "Load(" in shown.stdout and "proved optimal" in shown.stdout, shown.stderr
    data = json.loads(type_in("plan", "--goal", "lab:Goal contain lab:crate-2", "--cell", "yard", "--json").stdout)
    assert [each["skill"] for each in data["plan"]] == ["Load", "Unload"]
    assert type_in("plan", "--goal", "lab:Cart-1 contain lab:Goal", "--cell", "yard").exit_code == 3


def test_the_world_of_a_cell_is_shown_queried_and_edited(here: RunningServer) -> None:
    here.put_back()
    edited = type_in("scene", "edit", "--cell", "yard", "--why", "seen", "lab:Goal skiros:contain lab:crate-3")
    assert (edited.exit_code, edited.stderr) == (0, "yard: 1 edit applied\n"), edited.stderr
    shown = type_in("world", "--cell", "yard", "--show", "lab:Goal").stdout.splitlines()
    assert "lab:Goal contain lab:crate-3  (admin: seen)" in shown
    query = "SELECT ?crate { lab:Goal skiros:contain ?crate }"
    rows = json.loads(type_in("world", "--cell", "yard", "--query", query, "--json").stdout)
    assert rows == [{"crate": "lab:crate-3"}]
    last = type_in("world", "--cell", "yard", "--history").stdout.splitlines()[0]
    assert last.endswith("  admin: seen: lab:Goal contain lab:crate-3")
    assert (
        type_in("scene", "edit", "--cell", "yard", "--why", "back", "lab:Start skiros:contain lab:crate-3").exit_code
        == 0
    )


def test_tokens_are_made_listed_and_revoked(here: RunningServer, monkeypatch: pytest.MonkeyPatch) -> None:
    token = type_in("token", "add", "ada", "--role", "view").stdout.strip()
    assert ["ada", "view"] in [line.split()[:2] for line in type_in("token", "list").stdout.splitlines()]
    with monkeypatch.context() as patch:
        patch.setenv("SKILLC_TOKEN", token)
        assert type_in("ps").exit_code == 0
        refused = type_in("start", "carry_all")
        assert refused.exit_code == 1 and "this needs the role `operate`, and `ada` has `view`" in refused.stderr
    assert type_in("token", "revoke", "ada").exit_code == 0
    assert "ada" not in type_in("token", "list").stdout


def test_the_lease_of_a_cell_is_taken_shown_and_released(here: RunningServer, monkeypatch: pytest.MonkeyPatch) -> None:
    assert type_in("lease", "take", "--for", "100").stderr == "yard: admin has the lease for 100 s\n"
    token = type_in("token", "add", "bob", "--role", "operate").stdout.strip()
    with monkeypatch.context() as patch:
        patch.setenv("SKILLC_TOKEN", token)
        refused = type_in("start", "carry_all")
        assert refused.exit_code == 1 and "`admin` has the lease of yard" in refused.stderr
        assert type_in("lease", "take", "--takeover").exit_code == 1
    assert type_in("lease", "release").stderr == "yard: nobody has the lease\n"
    assert type_in("lease", "show").stdout == "yard: nobody has the lease\n"
    assert type_in("token", "revoke", "bob").exit_code == 0


def test_a_shell_offers_what_the_server_has(here: RunningServer, monkeypatch: pytest.MonkeyPatch) -> None:
    name = type_in("start", "carry_all", "--approve").stdout.strip()
    here.wait_for(name, "planned")
    offered = ShellComplete(skillc, {}, "skillc", "_SKILLC_COMPLETE")
    found = offered.get_completions(["pause"], "carry_")
    assert [(each.value, each.help) for each in found] == [(name, "planned: waits for approval")]
    assert [each.value for each in offered.get_completions(["start", "--cell"], "")] == ["yard"]
    assert type_in("start", "carry_all", "--at", "2100-01-01T00:00:00Z").exit_code == 0
    orders = offered.get_completions(["orders", "--remove"], "carry_")
    assert [each.help for each in orders] == ["carry_all"]
    assert type_in("orders", "--remove", orders[0].value).exit_code == 0
    with monkeypatch.context() as patch:
        patch.setenv("SKILLC_SERVER", "http://127.0.0.1:1")
        assert offered.get_completions(["pause"], "") == []


def test_who_attaches_sees_the_task_operates_it_and_detaches(here: RunningServer) -> None:
    here.put_back(pace=0.25)
    name = type_in("start", "carry_all", "--step").stdout.strip()
    with Terminal((sys.executable, "-m", "skillc", "attach", name), terminal_environment()) as terminal:
        terminal.expect(r"paused since [\d.]+ s: step: (Load|Unload) is next.*next  \1  .*d detach")
        terminal.type("p")
        terminal.expect(r"p \(pause\) is not possible while the task is paused; possible: s step over")
        terminal.type("s")
        terminal.expect(r"\[by_hand\] succeeded.*paused since")
        terminal.type("-c")
        terminal.expect(r"carry_all +[\d.]+ s  (Load|Unload)\s.*pace: 0.1")
        terminal.send(signal.SIGINT)
        assert terminal.wait() == 0
        assert f"{name} goes on; `skillc attach` shows it" in terminal.shown
        assert terminal.modes == terminal.modes_before
    assert here.client.get("/cells/yard").json()["pace"] == 0.1
    here.client.put("/cells/yard/pace", json={"factor": 0.05})
    assert here.client.get(f"/operations/{name}").json()["state"] == "running"
    with Terminal((sys.executable, "-m", "skillc", "attach"), terminal_environment()) as terminal:
        terminal.expect(r"q stop")
        terminal.type("q")
        assert terminal.wait() == 3
    assert here.wait_for(name, "stopped")["reason"] == "admin: stopped by the user"


def test_who_interrupts_waiting_is_told_that_the_task_goes_on(here: RunningServer) -> None:
    words = ("start", "--goal", "lab:Start contain lab:crate-0", "--approve", "--wait")
    with Terminal((sys.executable, "-m", "skillc", *words), terminal_environment()) as terminal:
        name = terminal.expect(r"operation-\w+-\w+")[0]
        here.wait_for(name, "planned")
        terminal.send(signal.SIGINT)
        assert terminal.wait() == 130
        assert f"{name} goes on" in terminal.shown
    assert here.client.get(f"/operations/{name}").json()["state"] == "planned"


def test_without_a_display_lines_are_printed(here: RunningServer) -> None:
    here.client.put("/cells/yard/pace", json={"factor": None})
    name = type_in("start", "--goal", "lab:Cart-1 contain lab:crate-5").stdout.strip()
    shown = type_in("attach", name)
    assert shown.exit_code == 0
    assert "proved optimal)" in shown.stderr and shown.stderr.endswith(("finished, not verified\n", "succeeded\n"))


def test_who_watches_gets_a_line_for_each_change(here: RunningServer, tmp_path: Path) -> None:
    with Terminal((sys.executable, "-m", "skillc", "ps", "--watch", "--json"), terminal_environment()) as terminal:
        terminal.expect('"operational"')
        name = type_in("start", "carry_all", "--approve").stdout.strip()
        terminal.expect(rf'"id":"{name}".*"state":"planned"')
        terminal.send(signal.SIGINT)
        assert terminal.wait() == 130
    wait_until(lambda: json.loads(type_in("ps", "--json").stdout)["operations"], bool)


def test_breakpoints_are_listed_and_replaced_while_an_operation_goes_on(here: RunningServer) -> None:
    here.put_back()
    name = here.submit(task="carry_two", breakpoints=["Load"])["id"]
    here.wait_for(name, "paused")
    assert type_in("breakpoints", name).stdout == "Load\n"
    replaced = type_in("breakpoints", "--breakpoints", "Unload")
    assert (replaced.exit_code, replaced.stdout) == (0, "Unload\n") and "paused: breakpoint at Load" in replaced.stderr
    assert type_in("resume").exit_code == 0
    assert f"{name}: paused: breakpoint at Unload" in type_in("wait").stderr
    refused = type_in("breakpoints", "--breakpoints", "Unlode")
    assert refused.exit_code == 1 and "breakpoint: there is no skill `Unlode`" in refused.stderr
    assert type_in("breakpoints", "--breakpoints", "Load", "--clear").exit_code == 2
    assert (type_in("breakpoints", "--clear").stdout, type_in("breakpoints").stdout) == ("", "")
