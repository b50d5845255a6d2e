"""A primitive that takes down its cell takes down nothing else: the server says so, and starts the cell again."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from running_cells.yard import write_yard
from server.running import RunningServer, serving, wait_until

SKILL = """
## Misbehave.
skill {name} {{
    noplan
}}
impl by_{name} of {name} {{ run python "bad:{name}" }}
"""
CODE = '''
import ctypes
import os
import time

import numpy as np

from skillc_runtime.primitives.primitive import Primitive, Status


class Late(Primitive):
    """Misbehaves after half a second, when whoever has submitted it knows."""

    def start(self):
        self.due = self.cell.now + 0.5

    def tick(self):
        if self.cell.now < self.due:
            return Status.RUNNING
        self.misbehave()
        return Status.SUCCESS


class Blocks(Late):
    def misbehave(self):
        time.sleep(1e6)


class Exits(Late):
    def misbehave(self):
        os._exit(7)


class Crashes(Late):
    def misbehave(self):
        ctypes.string_at(0)


class Devours(Late):
    def misbehave(self):
        self.eaten = [np.empty(2**30, np.uint8) for _ in range(10_000)]
'''
NAMES = ("Blocks", "Exits", "Crashes", "Devours")


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """A server of two cells, whose library has skills that misbehave."""
    folder = tmp_path_factory.mktemp("bad")
    write_yard(folder)
    (folder / "barn.ttl").write_bytes((folder / "yard.ttl").read_bytes())
    (folder / "bad.skill").write_text("".join(SKILL.format(name=each) for each in NAMES), encoding="utf-8")
    (folder / "bad.py").write_text(CODE, encoding="utf-8")
    with serving(folder, takes_ms=500, options=("--cell", "barn.ttl")) as running:
        wait_until(lambda: running.client.get("/cells/barn").json()["state"], lambda state: state == "operational")
        running.client.put("/cells/barn/pace", json={"factor": 1.0})
        yield running


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("Exits", "its process ended with code 7"),
        ("Crashes", "its process ended with signal 11"),
        pytest.param("Blocks", "its loop stood still for 30 s, so its process was ended", marks=pytest.mark.sim),
    ],
)
def test_a_primitive_that_ends_its_cell_ends_nothing_else(server: RunningServer, name: str, said: str) -> None:
    other = server.client.post("/cells/barn/operations", json={"task": "carry_all"}).json()["id"]
    server.wait_for(other, "running")
    server.client.put("/cells/yard/pace", json={"factor": 1.0})
    operation = server.submit(call=f"{name}()")["id"]
    wait_until(lambda: server.client.get("/cells/yard").json(), lambda cell: said in cell["reason"])
    ended = server.wait_for(operation, "interrupted")
    assert server.client.get(f"/operations/{other}").json()["state"] in ("running", "succeeded")
    server.wait_ready()
    assert server.client.get(f"/operations/{ended['id']}").json()["decisions"] == ["retry"]
    assert server.wait_for(server.submit(goal="lab:Start contain lab:crate-5")["id"], "succeeded")
    server.client.post(f"/operations/{other}/stop", json={})
    server.wait_for(other, "stopped", "succeeded")


def test_a_primitive_that_wants_all_memory_fails_and_its_cell_goes_on(server: RunningServer) -> None:
    before = server.client.get("/cells/yard").json()
    ended = server.wait_for(server.submit(call="Devours()")["id"], "failed")
    assert "MemoryError" in ended["reason"] or "Unable to allocate" in ended["reason"]
    assert server.client.get("/cells/yard").json() == before
