"""The wall clock of a server and its cell jumps while they work, and the monotonic clock does not.

`libfaketime` 0.9.10 cannot do that: with FAKETIME_DONT_FAKE_MONOTONIC each `time.sleep` of Python fails (EINVAL).
"""

from __future__ import annotations

import shutil
import struct
import subprocess
import threading
from pathlib import Path
from random import Random

import pytest
from msgspec import structs

from running_cells.checking import check_cell
from running_cells.yard import CRATES, find_settings
from server.running import serving

JUMPS_S = (-86400 * 400, -86400 * 3, -3600, -5, 5, 3600, 86400 * 3, 86400 * 400)


def test_nothing_is_lost_while_the_clock_jumps(tmp_path: Path) -> None:
    if shutil.which("cc") is None:
        pytest.skip("there is no C compiler to build the clock with")
    library, offset, chance = tmp_path / "clock.so", tmp_path / "offset", Random(0)
    source = Path(__file__).with_name("clock.c")
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-Wall", "-Werror", "-o", library, source], check=True)
    offset.write_bytes(struct.pack("=q", 0))
    ended = threading.Event()

    def jump() -> None:
        while not ended.wait(chance.uniform(0.02, 0.2)):
            offset.write_bytes(struct.pack("=q", chance.choice(JUMPS_S)))

    environment = {"LD_PRELOAD": str(library), "CLOCK_OFFSET": str(offset)}
    with serving(tmp_path, takes_ms=50, environment=environment) as server:
        jumping = threading.Thread(target=jump)
        jumping.start()
        try:
            assert server.client.put("/cells/yard/lease", json={"duration_s": 600}).status_code == 200
            server.client.put("/cells/yard/pace", json={"factor": 1.0})
            operation = server.submit(task="carry_all", deadline_s=120)["id"]
            for _ in range(5):
                server.wait_for(operation, "running")
                server.client.post(f"/operations/{operation}/commands", json={"type": "pause"})
                server.wait_for(operation, "paused")
                server.client.post(f"/operations/{operation}/commands", json={"type": "resume"})
            done = server.wait_for(operation, "succeeded", "failed")
            assert done["state"] == "succeeded", done
            again = server.submit(task="carry_all", deadline_s=120)["id"]
            assert server.wait_for(again, "succeeded", "failed")["state"] == "succeeded"
            listed = [each["id"] for each in server.client.get("/cells/yard/operations").json()]
            assert {*listed} == {operation, again}, "also those that were submitted later than now"
            events = server.client.get(f"/operations/{operation}/events").json()
            wall, cell = ([key(each) for each in events] for key in (lambda it: it["wall_time_ns"], cell_time))
            assert [each["sequence"] for each in events] == [*range(1, done["events"] + 1)]
            assert wall != sorted(wall), "the clock has jumped"
            assert cell == sorted(cell) and cell[-1] < 60.0
            assert server.client.get("/cells/yard/lease").json()["owner"] == "admin"
        finally:
            ended.set()
            jumping.join()
    settings = structs.replace(find_settings(tmp_path), folder=str(tmp_path / "served" / "cells" / "yard"))
    assert check_cell(settings)["lab:Goal"] == CRATES


def cell_time(envelope: dict[str, dict[str, float]]) -> float:
    """Return the time of an event on the clock of its cell in s."""
    return envelope["event"]["time"]
