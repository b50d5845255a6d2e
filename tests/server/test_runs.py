"""What operations have done: their trees, explanations, signals and differences, also while they go on."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import msgspec
import pytest

from running_cells.test_operations import run_all
from running_cells.test_reality import TABLE, make_settings
from server.running import RunningServer, wait_until
from server.test_recordings import CARRY
from skillc.cells.opening import open_cell
from skillc.contract.diagnosis import WorkRefused
from skillc.contract.operation import OperationRequest
from skillc.contract.runs.signals import SignalPage, SignalRows
from skillc.services.reporting.reporter import SilentReporter
from skillc.workers.answering import answer_work
from skillc.workers.run_reading import MAX_ROWS, MAX_VALUES, RunFiles, compare_runs, read_signals


def test_a_tree_is_shown_while_its_operation_waits_for_approval_and_its_events_have_its_numbers(
    server: RunningServer,
) -> None:
    server.put_back()
    server.client.put("/cells/yard/pace", json={"factor": None})
    operation = server.submit(**CARRY, approve=True)["id"]
    server.wait_for(operation, "planned")
    tree = wait_until(lambda: server.client.get(f"/operations/{operation}/tree").json(), lambda it: it.get("nodes"))
    calls = {each["id"]: each for each in tree["nodes"] if each["kind"] == "call"}
    assert [(each["skill"], each["arguments"]["crate"]) for each in calls.values()] == [
        ("Load", "lab:crate-0"),
        ("Unload", "lab:crate-0"),
    ]
    server.client.post(f"/operations/{operation}/commands", json={"type": "approve"})
    server.wait_for(operation, "succeeded")
    events = [each["event"] for each in server.client.get(f"/operations/{operation}/events").json()]
    started = {each["node"]: each for each in events if each["type"] == "node-started"}
    assert calls.keys() <= started.keys() and all(started[each]["kind"] == "call" for each in calls)
    after = server.client.get(f"/operations/{operation}/tree").json()
    assert after["sequence"] == len(events) and started.keys() <= {each["id"] for each in after["nodes"]}
    assert {each["implementation"] for each in after["nodes"] if each["id"] in calls} == {"by_hand"}


def test_a_run_is_explained_with_the_nodes_of_its_calls(server: RunningServer) -> None:
    server.put_back()
    server.client.put("/cells/yard/pace", json={"factor": None})
    operation = server.submit(**CARRY)["id"]
    server.wait_for(operation, "succeeded")
    why = server.client.get(f"/operations/{operation}/why", params={"question": "Load.from"}).json()
    assert why["lines"][0].startswith("carry(crate: lab:crate-0, to: lab:Goal): finished, not verified")
    assert any("lab:Start" in each for each in why["answer"])
    nodes = {each["id"]: each for each in server.client.get(f"/operations/{operation}/tree").json()["nodes"]}
    assert [(nodes[each["node"]]["skill"], each["lines"][0].split()[0]) for each in why["calls"]] == [
        ("Load", "1"),
        ("Unload", "2"),
    ]
    assert not any("skillc why" in each for each in why["lines"])
    refused = server.client.get(f"/operations/{operation}/why", params={"question": "Fly"})
    assert refused.status_code == 422 and "Fly" in refused.json()["detail"]


def test_two_runs_are_compared(server: RunningServer) -> None:
    server.put_back()
    server.client.put("/cells/yard/pace", json={"factor": None})
    other = {"task": "carry", "arguments": {"crate": "lab:crate-1", "to": "lab:Goal"}}
    first, second = (server.submit(**each)["id"] for each in (CARRY, other))
    for each in (first, second):
        server.wait_for(each, "succeeded")
    answer = server.client.get(f"/operations/{first}/diff", params={"other": second})
    assert answer.status_code == 200, answer.text
    diff = answer.json()
    assert diff["runs"] == [first, second]
    plans = [(each["first"], each["second"]) for each in diff["differences"] if each["part"] == "plan"]
    load = "Load(cart: lab:Cart-1, crate: lab:crate-{})"
    assert (load.format(0), load.format(1)) in plans
    assert str(server.folder) not in str(diff["runs"])


def test_a_run_is_compared_as_soon_as_its_task_has_begun(server: RunningServer) -> None:
    server.put_back()
    server.client.put("/cells/yard/pace", json={"factor": None})
    ended = server.submit(**CARRY)["id"]
    server.wait_for(ended, "succeeded")
    server.put_back()
    waiting = server.submit(**CARRY, approve=True)["id"]
    wait_until(lambda: server.client.get(f"/operations/{waiting}/events").json(), bool)
    begun = server.client.get(f"/operations/{ended}/diff", params={"other": waiting})
    server.client.post(f"/operations/{waiting}/commands", json={"type": "stop"})
    assert begun.status_code == 200, begun.text
    task = next(each for each in begun.json()["differences"] if each["what"] == "task")
    assert (task["first"], task["second"]) == ("finished, not verified", "not ended as far as it is recorded")


@pytest.mark.parametrize(
    ("path", "status"),
    [
        ("nothing/tree", 404),
        ("nothing/why", 404),
        ("nothing/signals", 404),
        ("{it}/diff", 422),
        ("{it}/diff?other=nothing", 404),
        ("{it}/signals?every_s=-1", 422),
        ("{it}/signals?every_s=nan", 422),
        ("{it}/signals?after_s=1e99", 422),
        ("{it}/signals?match=" + "a" * 501, 422),
        ("{it}/why?question=" + "a" * 201, 422),
        ("{it}/tree?depth=1", 422),
    ],
)
def test_what_does_not_exist_or_is_out_of_range_is_refused(server: RunningServer, path: str, status: int) -> None:
    operation = server.submit(**CARRY, approve=True)["id"]
    server.client.post(f"/operations/{operation}/stop", json={})
    answer = server.client.get(f"/operations/{path.format(it=operation)}")
    assert answer.status_code == status and answer.json()["detail"], answer.text


def test_signals_are_read_while_they_are_recorded(tmp_path: Path) -> None:
    settings = make_settings(tmp_path, TABLE, "kinematic")
    recording = Path(settings.folder) / "recordings" / "first.mcap"
    run = RunFiles("first", settings.journal, recording)
    with open_cell(settings, SilentReporter()) as host:
        assert isinstance(answer_work((partial(read_signals, run, SignalPage()), b"")), WorkRefused)
        refused = answer_work((partial(compare_runs, run, run), b""))
        assert isinstance(refused, WorkRefused) and "first has no events of a task: it has not begun" in str(refused)
        host.submit("first", OperationRequest(task=TABLE[1]))
        (ended,) = run_all(host)
        assert ended.state == "succeeded"
    whole = read(run, SignalPage("wrench,joint"))
    assert whole.signals and all("wrench" in each.column or "joint" in each.column for each in whole.signals)
    assert len(whole.columns) == len(whole.signals) and {len(each) for each in whole.columns} == {len(whole.time_s)}
    assert whole.more and len(whole.time_s) == min(MAX_ROWS, MAX_VALUES // len(whole.signals))
    rest = read(run, SignalPage("joint", whole.time_s[-1]))
    assert rest.time_s[0] > whole.time_s[-1] and rest.time_s[0] - whole.time_s[-1] < 2.0 * whole.every_s
    coarse = read(run, SignalPage("joint", 1.0, 3.0, 0.1))
    assert 18 <= len(coarse.time_s) <= 21 and not coarse.more and 1.0 < coarse.time_s[0] < coarse.time_s[-1] <= 3.0


def read(run: RunFiles, page: SignalPage) -> SignalRows:
    answer = answer_work((partial(read_signals, run, page), b""))
    assert isinstance(answer, bytes), answer
    return msgspec.json.decode(answer, type=SignalRows)


def test_breakpoints_are_set_while_an_operation_runs(server: RunningServer) -> None:
    server.put_back()
    operation = server.submit(task="carry_two", breakpoints=["Load"])["id"]
    server.wait_for(operation, "paused")
    commands = f"/operations/{operation}/commands"

    def set_breakpoints(*breakpoints: str) -> int:
        body = {"type": "set-breakpoints", "breakpoints": breakpoints}
        return server.client.post(commands, json=body).status_code

    assert set_breakpoints("Fly") == set_breakpoints("yard.skill:1") == set_breakpoints("/etc/passwd:1") == 409
    assert set_breakpoints(*(["Load"] * 101)) == set_breakpoints("a" * 301) == 422
    line = 1 + (server.folder / "yard.skill").read_text().splitlines().index(
        "        Unload(cart: lab:Cart-1, crate: lab:crate-0, to: lab:Goal)"
    )
    assert set_breakpoints(f"yard.skill:{line}") == 200
    server.client.post(commands, json={"type": "resume"})
    paused = wait_until(
        lambda: server.client.get(f"/operations/{operation}").json(),
        lambda it: it["state"] == "paused" and "Load" not in it["reason"],
    )
    assert paused["reason"] == f"breakpoint at yard.skill:{line}"
    server.client.post(f"/operations/{operation}/stop", json={})
    server.wait_for(operation, "stopped")


def test_a_history_is_searched_for_words_in_what_was_wanted_and_how_it_ended(server: RunningServer) -> None:
    server.put_back()
    server.client.put("/cells/yard/pace", json={"factor": None})
    carried = server.submit(**CARRY)["id"]
    server.wait_for(carried, "succeeded")

    def find(search: str) -> list[str]:
        found = server.client.get("/cells/yard/operations", params={"search": search, "limit": 3}).json()
        return [each["id"] for each in found]

    everything = server.client.get("/cells/yard/operations", params={"limit": 1000}).json()
    assert find(carried) == [carried]
    assert find("succeeded LAB:crate-0")[0] == carried
    put_back = [each["id"] for each in everything if "lab:Start contain c" in (each["request"].get("goal") or "")]
    assert put_back and find("lab:Start contain") == put_back[:3]
    assert find("no_such_word") == [] and find("carry no_such_word") == []
    assert find("") == [each["id"] for each in everything[:3]]
