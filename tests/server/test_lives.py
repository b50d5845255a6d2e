"""What a server keeps over its lives: it is killed, ends by each signal that asks it to, and is started again.

Starting a server takes long, so stories of several subjects share its lives.
"""

from __future__ import annotations

import os
import signal
import sqlite3
import stat
import time
from collections.abc import Callable, Generator
from contextlib import closing
from pathlib import Path

import httpx
import pytest
from click.testing import CliRunner, Result
from msgspec import structs

from running_cells.checking import check_cell
from running_cells.yard import find_settings
from server.running import RunningServer, find_cell_process, serving, wait_until
from server.test_keys import submit
from server.test_orders import add, find_submitted
from server.test_state import state
from server.test_trials import post
from skillc.cells.journal.reading import JournalReader
from skillc.cli.main import skillc
from skillc.server.jobs.store import SERIES, TRIALS
from skillc_runtime.recording.events import TaskEnded
from waiting import LONG_S

CRATE = "lab:crate-0"
LIVES = (
    (signal.SIGKILL, "operational"),
    (signal.SIGINT, "operational"),
    (signal.SIGTERM, "operational"),
    (signal.SIGHUP, "off"),
)
"""The signal that ends each life, and the state in which its cell is first."""

Story = Generator[None, RunningServer | None, None]
"""Begins in the first life; goes on when the server has ended, and again when it was started, with the server."""


def next_life() -> Generator[None, RunningServer | None, RunningServer]:
    """Let the server end and start again; return it."""
    yield
    server = yield
    assert server is not None
    return server


def carry(server: RunningServer, crate: str) -> str:
    submitted = server.submit(task="carry", arguments={"crate": crate, "to": "lab:Goal"})
    return str(server.wait_for(submitted["id"], "succeeded", "failed")["state"])


def list_brought(server: RunningServer) -> set[str]:
    """Return the crates that the world has in their goal."""
    there = server.client.get("/cells/yard/world", params={"subject": "lab:Goal"}).json()["facts"]
    return {each["fact"]["object"]["label"] for each in there if each["fact"]["type"] == "relation"}


def the_pace_that_was_set_last_is_that_of_the_next_life(server: RunningServer) -> Story:
    server.client.put("/cells/yard/pace", json={"factor": 100.0})
    for _ in range(2):  # the second life ends with the backup of the first one in its place
        server = yield from next_life()
        assert server.client.get("/cells/yard").json()["pace"] == 100.0
        server.client.put("/cells/yard/pace", json={"factor": None})


def a_session_and_a_database_of_an_older_format_survive(server: RunningServer) -> Story:
    secret = server.client.post("/session").headers["set-cookie"].partition("=")[2].split(";")[0]
    server = yield from next_life()
    cookie = {"Cookie": f"skillc-{server.port}={secret}"}
    assert httpx.get(f"{server.url}/session", headers=cookie).json() == {"name": "admin", "role": "admin"}
    yield
    with closing(sqlite3.connect(server.folder / "served/server.sqlite")) as database:
        database.execute("DROP TABLE sessions")
        database.execute("ALTER TABLE tokens DROP COLUMN agent")
        for each in (*("DROP TABLE jobs", "DROP TABLE job_events"), SERIES, TRIALS):
            database.execute(each)
        trial = b'{"seed": 7, "status": "succeeded"}'
        database.execute("INSERT INTO trial_series VALUES (1, 'old', 'yard', '{\"task\": \"carry_all\"}', 'ended', '')")
        database.execute("INSERT INTO trials VALUES ('old', 7, 1, ?)", (trial,))
        database.commit()
        database.execute("PRAGMA user_version = 3")
    migrated = yield
    assert migrated is not None and migrated.client.post("/session").status_code == 204
    assert (server.folder / "served/server.sqlite.format-3").exists()
    old = migrated.client.get("/jobs/old").json()
    assert (old["cell"], old["state"], old["done"], old["wanted"]) == ("yard", "ended", 1, 50)
    assert [each["seed"] for each in migrated.find_outcome("old")["series"]["trials"]] == [7]


def a_backup_is_restored_in_the_place_of_a_state_that_nobody_uses(server: RunningServer) -> Story:
    copy, served = server.folder / "copy", server.folder / "served"
    assert carry(server, CRATE) == "succeeded"
    before = [each["id"] for each in server.client.get("/cells/yard/operations").json()]
    done = state("backup", copy, "--state", served)
    assert done.exit_code == 0, done.output
    later = server.submit(goal=f"lab:Goal contain {CRATE}")["id"]
    server.wait_for(later, "succeeded")
    refused = state("restore", copy, "--state", served)
    assert refused.exit_code == 2 and "is in use by process" in refused.output
    server = yield from next_life()
    assert server.client.get(f"/operations/{later}").status_code == 200
    yield
    done = state("restore", copy, "--state", served)
    assert done.exit_code == 0 and "the former one is" in done.output
    assert sorted(each.name for each in server.folder.glob("served.until-*/cells/*")) == ["yard"]
    restored = yield
    assert restored is not None and restored.client.get(f"/operations/{later}").status_code == 404
    assert [each["id"] for each in restored.client.get("/cells/yard/operations").json()] == before
    assert list_brought(restored) == {CRATE}


def only_the_owner_reads_the_state(server: RunningServer) -> Story:
    """The folder existed, for everybody to read, before the server was first started."""
    served = server.folder / "served"
    server.wait_for(server.submit(goal=f"lab:Goal contain {CRATE}")["id"], "succeeded")
    found, journal = [*served.rglob("*")], served / "cells/yard/journal.sqlite"
    assert journal in found and any(each.suffix == ".mcap" for each in found)
    assert [each for each in found if permissions(each) & 0o077] == []
    yield
    journal.chmod(0o644)
    yield
    assert permissions(journal) == 0o600


def permissions(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def a_request_whose_key_was_noted_is_submitted_once_later(server: RunningServer) -> Story:
    first = submit(server)
    assert first.status_code == 201
    yield
    with closing(sqlite3.connect(server.folder / "served/server.sqlite")) as database, database:
        database.execute("UPDATE requests SET operation = 'carry-never-heard-of'")
    again = yield
    assert again is not None
    assert [submit(again).json()["id"] for _ in range(2)] == ["carry-never-heard-of"] * 2
    listed = again.client.get("/cells/yard/operations").json()
    found = [each["id"] for each in listed if each["request"].get("approve")]
    assert found == ["carry-never-heard-of", first.json()["id"]]
    again.client.post("/operations/carry-never-heard-of/stop", json={})


def orders_that_were_due_meanwhile_are_submitted_once(server: RunningServer) -> Story:
    order = add(server, 0.0, every_s=1.0, request={"goal": f"lab:Goal contain {CRATE}"}).json()["id"]
    wait_until(lambda: find_submitted(server, order), bool)
    yield
    time.sleep(2.0)
    again = yield
    assert again is not None

    def find_numbers() -> list[int]:
        return sorted(int(each.rpartition("-")[2]) for each in find_submitted(again, order))

    # However many there were before: those that came due while there was no server have no operations.
    wait_until(find_numbers, lambda numbers: bool(numbers) and numbers[-1] > len(numbers))
    again.client.delete(f"/orders/{order}")
    numbers = find_numbers()
    assert len(set(numbers)) == len(numbers)


def jobs_of_each_kind_are_interrupted_and_begun_again(server: RunningServer) -> Story:
    operation = server.submit(goal="lab:Start contain lab:crate-3")["id"]  # it is there: other stories count crates
    server.wait_for(operation, "succeeded")
    ended = post(server, number=1)["id"]
    server.wait_for_job(ended, "ended")
    trials = post(server, number=1000)["id"]
    wait_until(lambda: server.client.get(f"/jobs/{trials}").json(), lambda found: found["done"] > 1)
    requests = {
        "rehearsal": {"goal": f"lab:Start contain {CRATE}"},
        "report": {"operation": operation, "film": False},
        "trial-replay": {"trials": ended, "seed": 0},
        "plan": {"goal": f"lab:Start contain {CRATE}"},
    }
    begun = [server.begin(kind, **request)["id"] for kind, request in requests.items()]
    server = yield from next_life()
    kept = {each["id"]: each for each in server.client.get("/jobs").json()}
    assert {ended, trials, *begun} <= kept.keys(), "none is lost"
    assert (kept[ended]["state"], kept[ended]["failed"]) == ("ended", 0)
    assert (kept[trials]["state"], kept[trials]["reason"]) == ("interrupted", "the server has ended")
    series = server.find_outcome(trials)["series"]
    assert series["done"] == len(series["trials"]) == kept[trials]["done"] > 1
    interrupted = [each for each in begun if kept[each]["state"] == "interrupted"]
    assert interrupted, "they wait for each other"
    for each in interrupted:
        assert server.client.post(f"/jobs/{each}/restart").status_code == 200
    again = [server.wait_for_job(each) for each in begun]
    assert [(each["state"], each["reason"]) for each in again] == [("ended", "")] * len(begun)
    assert server.client.post(f"/jobs/{trials}/restart").json()["done"] == kept[trials]["done"]
    wait_until(lambda: server.client.get(f"/jobs/{trials}").json()["done"], lambda done: done > kept[trials]["done"])
    assert server.client.delete(f"/jobs/{trials}").status_code == 204


def run_beside(folder: Path) -> Result:
    """Carry a crate in this process, with the store of the cell."""
    words = (f"{folder}:carry", "crate=lab:crate-4", "to=lab:Goal", "--backend", "kinematic")
    store = folder / "served/cells/yard/world"
    return CliRunner().invoke(skillc, ["run", *words, "--store", str(store), "--out", str(folder / "out")])


def adopt(cell: str, served: Path) -> Result:
    return CliRunner().invoke(skillc, ["state", "adopt", cell, "--why", "I saw it", "--state", str(served)])


def a_store_belongs_to_its_cell_and_what_others_changed_is_adopted_by_a_person(server: RunningServer) -> Story:
    server = yield from next_life()
    assert carry(server, "lab:crate-1") == "succeeded"
    first = find_cell_process(server)
    assert refused_beside(server).startswith(f"the cell yard (process {first})")
    os.kill(first, signal.SIGKILL)
    wait_until(lambda: server.client.get("/cells/yard").json()["state"], lambda found: found == "off")
    server.wait_ready()
    assert refused_beside(server).startswith(f"the cell yard (process {find_cell_process(server)})")
    assert carry(server, "lab:crate-2") == "succeeded"
    brought = list_brought(server)
    yield
    settings = structs.replace(find_settings(server.folder), folder=str(server.folder / "served/cells/yard"))
    assert check_cell(settings)["lab:Goal"] == len(brought) == 3, "no fact was lost"
    server = (yield) or server
    yield
    beside = run_beside(server.folder)
    assert beside.exit_code == 0, beside.output
    server = (yield) or server
    adopt_changes(server)


def refused_beside(server: RunningServer) -> str:
    """Return to whom the store belongs, as is said to somebody else who wants to write to it."""
    refused = run_beside(server.folder)
    assert refused.exit_code == 1 and "and nobody else may write to it" in refused.output, refused.output
    return refused.output.partition("belongs to ")[2]


def adopt_changes(server: RunningServer) -> None:
    """Adopt what was changed while the cell was off."""
    off = wait_until(lambda: server.client.get("/cells/yard").json(), lambda it: "facts" in it["reason"])
    assert "does not have the facts that its cell wrote" in off["reason"] and "skillc state adopt" in off["reason"]
    assert server.client.post("/cells/yard/acknowledge").status_code in (409, 503)
    assert server.client.post("/cells/yard/operations", json={"task": "carry_all"}).status_code == 503
    unknown = adopt("yrad", server.folder / "served")
    assert unknown.exit_code == 2 and "has no cell yrad; it has yard" in unknown.output
    adopted = adopt("yard", server.folder / "served")
    assert adopted.exit_code == 0, adopted.output
    server.wait_ready()
    history = server.client.get("/cells/yard/world/history", params={"limit": 2}).json()
    assert [each["changes"] for each in history if each["origin"].endswith(": I saw it")] == [[]]
    assert list_brought(server) == {CRATE, "lab:crate-4"}
    assert carry(server, "lab:crate-5") == "succeeded"
    refused = adopt("yard", server.folder / "served")
    assert refused.exit_code == 1 and "belongs to the cell yard (process" in refused.output


def operations_have_an_end_and_the_exit_code_is_0(server: RunningServer) -> Story:
    server = yield from next_life()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        server.client.put("/cells/yard/pace", json={"factor": 0.5})
        operation = server.submit(goal="lab:Cart-1 contain lab:crate-3")["id"]
        server.wait_for(operation, "running")
        yield
        assert server.process.returncode == 0 and server.process.stderr is not None
        said = server.process.stderr.read().decode()
        assert f"ended by {number.name}: all devices are at rest" in said
        assert f"serving at {server.url.removesuffix('/api/v1')}" in said and "admin.token" in said
        assert server.token not in said
        with closing(JournalReader(server.folder / "served/cells/yard/journal.sqlite")) as reader:
            found, events = reader.find(operation), reader.envelopes(operation)
        assert found is not None and found.ended is not None and found.ended.state == "interrupted"
        assert isinstance(events[-1].event, TaskEnded)
        if number is not signal.SIGHUP:
            assert "cell yard: operational, as fast as it computes" in said
            server = (yield) or server


STORIES: tuple[Callable[[RunningServer], Story], ...] = (
    the_pace_that_was_set_last_is_that_of_the_next_life,
    a_session_and_a_database_of_an_older_format_survive,
    a_backup_is_restored_in_the_place_of_a_state_that_nobody_uses,
    only_the_owner_reads_the_state,
    jobs_of_each_kind_are_interrupted_and_begun_again,
    a_request_whose_key_was_noted_is_submitted_once_later,
    orders_that_were_due_meanwhile_are_submitted_once,
    a_store_belongs_to_its_cell_and_what_others_changed_is_adopted_by_a_person,
    operations_have_an_end_and_the_exit_code_is_0,
)
"""In this order with a server that runs, and the other way round when it has ended.

Jobs begin after what takes long in the first life, so that it ends before they do, and before operations that go on.
"""


@pytest.mark.early
def test_what_a_server_keeps_over_its_lives(tmp_path: Path) -> None:
    (tmp_path / "served").mkdir(mode=0o755)
    stories = list[Story]()
    for life, (ends_by, first) in enumerate(LIVES):
        with serving(tmp_path, takes_ms=1000, state=first) as server:
            stories = stories or [each(server) for each in STORIES]
            stories = [each for each in stories if goes_on(each, server if life else None)]
            server.process.send_signal(ends_by)
            server.process.wait(LONG_S)
        stories = [each for each in reversed(stories) if goes_on(each, None)][::-1]
    assert not stories, "they end before the server does for the last time"


def goes_on(story: Story, server: RunningServer | None) -> bool:
    """Let a story go on; return whether it has not ended."""
    try:
        story.send(server)
    except StopIteration:
        return False
    return True
