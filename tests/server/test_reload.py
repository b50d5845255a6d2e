"""A library that changes on disk is checked and taken for the next operation; code that is new is not."""

from __future__ import annotations

import os
import signal
import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from running_cells.yard import SKILLS, write_yard
from server.running import RunningServer, serving, start_server, wait_until
from server.test_client_commands import type_in

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


@pytest.fixture
def server(tmp_path: Path) -> Iterator[RunningServer]:
    with serving(tmp_path / "yard", takes_ms=500) as running:
        running.client.put("/cells/yard/pace", json={"factor": 1.0})
        yield running


def text(takes_ms: int = 500) -> str:
    return SKILLS.replace("TAKES", str(takes_ms))


def write(server: RunningServer, content: str) -> None:
    (server.folder / "yard.skill").write_text(content, encoding="utf-8")


def cell(server: RunningServer) -> Any:
    return server.client.get("/cells/yard").json()


def find_cell_process(server: RunningServer) -> int:
    """Return the id of the process of the cell."""
    children = Path(f"/proc/{server.process.pid}/task/{server.process.pid}/children").read_text().split()
    return next(int(each) for each in children if b"skillc.cells" in Path(f"/proc/{each}/cmdline").read_bytes())


def test_a_change_is_taken_for_the_next_operation(server: RunningServer) -> None:
    before = cell(server)["library_hash"]
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
    os.kill(find_cell_process(server), signal.SIGKILL)
    wait_until(lambda: cell(server)["state"], lambda state: state == "off")
    server.wait_ready()
    assert cell(server)["library_hash"] == before
    assert server.wait_for(server.submit(goal="lab:Goal contain lab:crate-1")["id"], "succeeded")
    write(server, text())
    wait_until(lambda: cell(server)["library_problem"], lambda found: not found)
    assert cell(server)["library_hash"] == before


def test_code_that_was_not_there_at_first_is_not_run(server: RunningServer) -> None:
    (server.folder / "horn.py").write_text(CODE, encoding="utf-8")
    write(server, text() + WITH_CODE)
    problem = wait_until(lambda: cell(server)["library_problem"], bool)
    assert "names the Python module horn, with which the server was not started" in problem
    assert "start the server again to use it" in problem
    assert not (server.folder / "loaded").exists()
    assert server.client.post("/cells/yard/operations", json={"call": "Beep()"}).status_code == 409
    write(server, text() + 'function blow(cart: lab:Cart) -> Bool = python "horn:blow"\n')
    changed = wait_until(lambda: cell(server)["library_problem"], lambda found: "names" not in found)
    assert "its vocabulary has changed" in changed and not (server.folder / "loaded").exists()


def test_code_that_has_changed_is_not_loaded_by_a_cell_that_dies(tmp_path: Path) -> None:
    folder = tmp_path / "yard"
    write_yard(folder)
    (folder / "horn.py").write_text(CODE, encoding="utf-8")
    (folder / "horn.skill").write_text(f"# A horn.\n{WITH_CODE}", encoding="utf-8")
    with serving(folder) as server:
        assert server.wait_for(server.submit(call="Beep()")["id"], "succeeded")
        (folder / "horn.py").write_text(f"{CODE}\nPath(__file__).with_name('changed').touch()\n", encoding="utf-8")
        problem = wait_until(lambda: cell(server)["library_problem"], bool)
        assert "Python files have changed (horn.py), which is not loaded" in problem
        assert server.wait_for(server.submit(call="Beep()")["id"], "succeeded")
        os.kill(find_cell_process(server), signal.SIGKILL)
        wait_until(lambda: cell(server)["reason"], lambda reason: "Python files have changed (horn.py)" in reason)
        assert cell(server)["state"] == "off" and not (folder / "changed").exists()
        (folder / "horn.py").write_text(CODE, encoding="utf-8")
        server.wait_ready()
        (folder / "sounds").mkdir()
        (folder / "sounds" / "tone.py").write_text("", encoding="utf-8")
        wait_until(lambda: cell(server)["library_problem"], lambda found: "(tone.py)" in found)


def test_a_cell_has_the_library_in_whose_folder_its_scene_is(tmp_path: Path) -> None:
    for name in ("north", "south"):
        write_yard(tmp_path / name)
        (tmp_path / name / "yard.ttl").rename(tmp_path / name / f"{name}.ttl")
    with (tmp_path / "south" / "yard.skill").open("a", encoding="utf-8") as file:
        file.write(NEW_TASK.replace("yard.ttl", "south.ttl"))
    for name in ("north", "south"):
        skills = tmp_path / name / "yard.skill"
        skills.write_text(skills.read_text().replace("yard.ttl", f"{name}.ttl"), encoding="utf-8")
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    cells = ("--cell", "north/north.ttl", "--cell", "south/south.ttl")
    process = start_server(tmp_path, port, libraries=("north", "south"), cells=cells)
    try:
        url = f"http://127.0.0.1:{port}/api/v1"
        wait_until(lambda: is_up(url) or process.poll() is not None, bool)
        token = (tmp_path / "served" / "admin.token").read_text().strip()
        with httpx.Client(base_url=url, headers={"Authorization": f"Bearer {token}"}, timeout=30.0) as client:
            wait_until(
                lambda: {each["state"] for each in client.get("/cells").json()}, lambda it: it == {"operational"}
            )
            hashes = {each["name"]: each["library_hash"] for each in client.get("/cells").json()}
            assert len(set(hashes.values())) == 2
            refused = client.post("/cells/north/operations", json={"task": "carry_first"})
            assert refused.status_code == 409 and "there is no task `carry_first`" in refused.json()["detail"]
            assert client.post("/cells/south/operations", json={"task": "carry_first"}).status_code == 201
            assert {each["hash"] for each in client.get("/libraries").json()} == set(hashes.values())
    finally:
        process.send_signal(signal.SIGTERM)
        process.wait(30.0)


def is_up(url: str) -> bool:
    """Whether the server answers."""
    try:
        return httpx.get(f"{url}/health").status_code == 200
    except httpx.TransportError:
        return False
