"""A library that changes on disk is checked and taken for the next operation; code that is new is not."""

from __future__ import annotations

import asyncio
import os
import shutil
import signal
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from running_cells.yard import SKILLS, write_yard
from server.running import RunningServer, serving, wait_until
from server.test_client_commands import type_in
from skillc.server import served_library
from skillc.server.served_library import open_library
from skillc_runtime.execution.worker_process import Died, WorkerProcess
from waiting import LONG_S

NEW_TASK = """
## Carry the first crate.
task carry_first {
    scene "yard.ttl"
    goal lab:Goal contain lab:crate-0
}
"""
WITH_CODE = """
## Beep.
skill Beep {
    noplan
}
impl by_horn of Beep { run python "horn:Beep" }
"""
CODE = """
from pathlib import Path

from skillc_runtime.primitives.primitive import Primitive, Status

Path(__file__).with_name("loaded").touch()


class Beep(Primitive):
    def tick(self):
        return Status.SUCCESS
"""


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """A server of a yard that beeps, and of another library in a folder beside it, with a cell of its own."""
    folder, south = tmp_path_factory.mktemp("reload") / "yard", "south.ttl"
    write_yard(folder.parent / "south")
    (folder.parent / "south" / "yard.ttl").rename(folder.parent / "south" / south)
    skills = (SKILLS.replace("TAKES", "500") + NEW_TASK).replace("yard.ttl", south)
    (folder.parent / "south" / "yard.skill").write_text(skills, encoding="utf-8")
    folder.mkdir()
    (folder / "horn.py").write_text(CODE, encoding="utf-8")
    (folder / "horn.skill").write_text(f"# A horn.\n{WITH_CODE}", encoding="utf-8")
    options = ("--cell", f"../south/{south}")
    with serving(folder, takes_ms=500, options=options, libraries=(".", "../south")) as running:
        yield running


@pytest.fixture(autouse=True)
def unchanged(server: RunningServer) -> Iterator[None]:
    """The library is as it was at first before each test; the pace is real."""
    first = cell(server)["library_hash"]
    server.client.put("/cells/yard/pace", json={"factor": 1.0})
    yield
    (server.folder / "horn.py").write_text(CODE, encoding="utf-8")
    (server.folder / "whistle.py").unlink(missing_ok=True)
    write(server, text())
    wait_until(lambda: cell(server), lambda it: (it["library_hash"], it["library_problem"]) == (first, ""))


def text(takes_ms: int = 500) -> str:
    return SKILLS.replace("TAKES", str(takes_ms))


def write(server: RunningServer, content: str) -> None:
    (server.folder / "yard.skill").write_text(content, encoding="utf-8")


def cell(server: RunningServer) -> Any:
    return server.client.get("/cells/yard").json()


def find_yard_process(server: RunningServer) -> int:
    """Return the process of the cell `yard`, which the file of its store has."""
    text = (server.folder / "served/cells/yard/world/owner").read_text()
    assert text.startswith("the cell yard (process ")
    return int(text.rpartition(" ")[2].rstrip(")"))


def test_a_change_is_taken_for_the_next_operation(server: RunningServer) -> None:
    before = cell(server)["library_hash"]
    server.client.put("/cells/yard/pace", json={"factor": 0.2})
    running = server.submit(task="carry_all")["id"]
    server.wait_for(running, "running")
    write(server, text() + NEW_TASK)
    after = wait_until(lambda: cell(server)["library_hash"], lambda found: found != before)
    assert server.client.get(f"/operations/{running}").json()["library_hash"] == before
    assert after in [each["hash"] for each in server.client.get("/libraries").json()]
    server.client.post(f"/operations/{running}/stop", json={})
    server.wait_for(running, "stopped")
    server.client.put("/cells/yard/pace", json={"factor": None})
    new = server.submit(task="carry_first")
    assert new["library_hash"] == after and server.wait_for(new["id"], "succeeded")


def test_an_error_keeps_the_library_that_was_checked(server: RunningServer, monkeypatch: pytest.MonkeyPatch) -> None:
    before = cell(server)["library_hash"]
    write(server, text() + NEW_TASK.replace("contain", "contains"))
    problem = wait_until(lambda: cell(server)["library_problem"], bool)
    assert "yard.skill" in problem and "there is no relation `contains`" in problem
    monkeypatch.setenv("SKILLC_SERVER", f"http://127.0.0.1:{server.port}")
    monkeypatch.setenv("SKILLC_TOKEN", server.token)
    assert "there is no relation `contains`" in type_in("ps").stdout
    os.kill(find_yard_process(server), signal.SIGKILL)
    wait_until(lambda: cell(server)["state"], lambda state: state == "off")
    server.wait_ready()
    assert cell(server)["library_hash"] == before
    assert server.wait_for(server.submit(goal="lab:Goal contain lab:crate-1")["id"], "succeeded")
    write(server, text())
    wait_until(lambda: cell(server)["library_problem"], lambda found: not found)
    assert cell(server)["library_hash"] == before


def test_code_that_was_not_there_at_first_is_not_run(server: RunningServer) -> None:
    whistle = WITH_CODE.replace("Beep", "Whistle").replace("horn", "whistle")
    code = CODE.replace("loaded", "whistled").replace("Beep", "Whistle")
    (server.folder / "whistle.py").write_text(code, encoding="utf-8")
    write(server, text() + whistle)
    problem = wait_until(lambda: cell(server)["library_problem"], bool)
    assert "names the Python module whistle, with which the server was not started" in problem
    assert "start the server again to use it" in problem
    assert not (server.folder / "whistled").exists()
    assert server.client.post("/cells/yard/operations", json={"call": "Whistle()"}).status_code == 409
    write(server, text() + 'function blow(cart: lab:Cart) -> Bool = python "whistle:blow"\n')
    changed = wait_until(lambda: cell(server)["library_problem"], lambda found: "names" not in found)
    assert "its vocabulary has changed" in changed and not (server.folder / "whistled").exists()


def test_code_that_has_changed_is_not_loaded_by_a_cell_that_dies(server: RunningServer) -> None:
    folder = server.folder
    server.client.put("/cells/yard/pace", json={"factor": None})
    assert server.wait_for(server.submit(call="Beep()")["id"], "succeeded") and (folder / "loaded").exists()
    (folder / "horn.py").write_text(f"{CODE}\nPath(__file__).with_name('changed').touch()\n", encoding="utf-8")
    problem = wait_until(lambda: cell(server)["library_problem"], bool)
    assert "Python files have changed (horn.py), which is not loaded" in problem
    assert server.wait_for(server.submit(call="Beep()")["id"], "succeeded")
    os.kill(find_yard_process(server), signal.SIGKILL)
    wait_until(lambda: cell(server)["reason"], lambda reason: "Python files have changed (horn.py)" in reason)
    assert cell(server)["state"] == "off" and not (folder / "changed").exists()
    (folder / "horn.py").write_text(CODE, encoding="utf-8")
    server.wait_ready()


def test_new_code_counts_only_if_what_runs_could_import_it(server: RunningServer) -> None:
    sounds = server.folder / "sounds"
    sounds.mkdir()
    (sounds / "tone.py").write_text("", encoding="utf-8")
    before = cell(server)["library_hash"]
    write(server, text() + NEW_TASK)
    wait_until(lambda: cell(server), lambda it: it["library_hash"] != before and not it["library_problem"])
    os.kill(find_yard_process(server), signal.SIGKILL)
    wait_until(lambda: cell(server)["state"], lambda state: state == "off")
    server.wait_ready()
    (sounds / "pathlib.py").write_text("", encoding="utf-8")  # `horn` imports that of Python
    wait_until(lambda: cell(server)["library_problem"], lambda found: "(pathlib.py)" in found)
    shutil.rmtree(sounds)


def test_a_cell_has_the_library_in_whose_folder_its_scene_is(server: RunningServer) -> None:
    wait_until(lambda: server.client.get("/cells/south").json()["state"], lambda state: state == "operational")
    hashes = {each["name"]: each["library_hash"] for each in server.client.get("/cells").json()}
    assert len(hashes) == len(set(hashes.values())) == 2
    refused = server.client.post("/cells/yard/operations", json={"task": "carry_first"})
    assert refused.status_code == 409 and "there is no task `carry_first`" in refused.json()["detail"]
    taken = server.client.post("/cells/south/operations", json={"task": "carry_first"})
    assert taken.status_code == 201 and server.wait_for(taken.json()["id"], "succeeded")
    assert {each["hash"] for each in server.client.get("/libraries").json()} == set(hashes.values())


def test_a_server_that_ends_does_not_wait_for_a_check(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_yard(tmp_path)
    started, library = list[WorkerProcess](), open_library(tmp_path, ())

    def start(*arguments: Any) -> WorkerProcess:
        started.append(WorkerProcess(*arguments))
        loop.call_soon_threadsafe(keeping.cancel)
        time.sleep(0.2)  # the server ends before the check has begun
        return started[-1]

    async def keep_up() -> None:
        nonlocal loop, keeping
        loop, keeping = asyncio.get_running_loop(), asyncio.create_task(library.keep_up(()))
        await asyncio.wait((keeping,), timeout=LONG_S)

    loop: asyncio.AbstractEventLoop
    keeping: asyncio.Task[None]
    monkeypatch.setattr(served_library, "WorkerProcess", start)
    library.touched = True
    asyncio.run(keep_up())
    assert [each.poll() for each in started] == [Died("it was killed")]
