"""A primitive that takes down its cell takes down nothing else: the server says so, and starts the cell again."""

from __future__ import annotations

import pytest

from server.running import RunningServer, wait_until

LONG = (pytest.mark.early, pytest.mark.sim)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("Exits", "its process ended with code 7"),
        ("Crashes", "its process ended with signal 11"),
        pytest.param("Blocks", "its loop stood still for 30 s, so its process was ended", marks=LONG),
    ],
)
def test_a_primitive_that_ends_its_cell_ends_nothing_else(bench: RunningServer, name: str, said: str) -> None:
    bench.client.put("/cells/bench/pace", json={"factor": 1.0})
    other = bench.client.post("/cells/bench/operations", json={"call": "Rest()"}).json()["id"]
    bench.wait_for(other, "running")
    bench.client.put("/cells/yard/pace", json={"factor": 1.0})
    operation = bench.submit(call=f"{name}()")["id"]
    wait_until(lambda: bench.client.get("/cells/yard").json(), lambda cell: said in cell["reason"])
    ended = bench.wait_for(operation, "interrupted")
    assert bench.client.get(f"/operations/{other}").json()["state"] == "running"
    bench.wait_ready()
    assert bench.client.get(f"/operations/{ended['id']}").json()["decisions"] == ["retry"]
    assert bench.wait_for(bench.submit(goal="lab:Start contain lab:crate-5")["id"], "succeeded")
    bench.client.post(f"/operations/{other}/stop", json={})
    bench.wait_for(other, "stopped")


def test_a_primitive_that_wants_all_memory_fails_and_its_cell_goes_on(bench: RunningServer) -> None:
    before = bench.client.get("/cells/yard").json()
    ended = bench.wait_for(bench.submit(call="Devours()")["id"], "failed")
    assert "MemoryError" in ended["reason"] or "Unable to allocate" in ended["reason"]
    assert bench.client.get("/cells/yard").json() == before
