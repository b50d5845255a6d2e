"""The wall clock of a server and its cell jumps while they work, and the monotonic clock does not.

`libfaketime` 0.9.10 cannot do that: with FAKETIME_DONT_FAKE_MONOTONIC each `time.sleep` of Python fails (EINVAL).
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random
from struct import Struct

import pytest
from msgspec import structs

from running_cells.checking import check_cell
from running_cells.yard import CRATES, find_settings
from server.running import RunningServer, serving
from skillc_runtime.recording.states import ENDS

OFFSET = Struct("=q")
JUMPS_S = (-86400 * 400, -86400 * 3, -3600, -5, 5, 3600, 86400 * 3, 86400 * 400)
MAX_PAUSES = 10


def test_nothing_is_lost_while_the_clock_jumps(tmp_path: Path) -> None:
    if sys.platform != "linux" or shutil.which("cc") is None:
        pytest.skip("there is no C compiler for Linux to build the clock with")
    offset, environment = build_clock(tmp_path)
    with serving(tmp_path, takes_ms=100, environment=environment) as server:
        with jumping(offset):
            assert server.client.put("/cells/yard/lease", json={"duration_s": 600}).status_code == 200
            server.client.put("/cells/yard/pace", json={"factor": 0.5})
            began_s = time.monotonic()
            operation = server.submit(task="carry_all", deadline_s=120)["id"]
            pauses = pause_until_ended(server, operation)
            done = server.wait_for(operation, *ENDS)
            elapsed_s = time.monotonic() - began_s
            assert done["state"] == "succeeded" and pauses > 0, (done, pauses)
            again = server.submit(task="carry_all", deadline_s=120)["id"]
            assert server.wait_for(again, *ENDS)["state"] == "succeeded"
            assert server.client.get("/cells/yard/lease").json()["owner"] == "admin"
        set_clock(offset, 2 * min(JUMPS_S))
        listed = {each["id"] for each in server.client.get("/cells/yard/operations").json()}
        assert listed == {operation, again}, "also those that were submitted later than now"
        events = server.client.get(f"/operations/{operation}/events").json()
    assert [each["sequence"] for each in events] == [*range(1, done["events"] + 1)]
    wall_ns, cell_s = [each["wall_time_ns"] for each in events], [each["event"]["time"] for each in events]
    assert wall_ns != sorted(wall_ns), "the clock has jumped"
    assert cell_s == sorted(cell_s) and cell_s[-1] - cell_s[0] < elapsed_s + 1.0
    settings = structs.replace(find_settings(tmp_path), folder=str(tmp_path / "served" / "cells" / "yard"))
    assert check_cell(settings)["lab:Goal"] == CRATES


def build_clock(folder: Path) -> tuple[Path, dict[str, str]]:
    """Build a wall clock that can be set; return the file with its offset, and the environment of those who use it."""
    library, offset, source = folder / "clock.so", folder / "offset", Path(__file__).with_name("clock.c")
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-Wall", "-Werror", "-o", library, source], check=True)
    offset.write_bytes(bytes(OFFSET.size))
    return offset, {"LD_PRELOAD": str(library), "CLOCK_OFFSET": str(offset)}


def set_clock(offset: Path, seconds: int) -> None:
    """Set the clock, in place: processes that have mapped the file may read it at any time."""
    with offset.open("r+b") as file:
        file.write(OFFSET.pack(seconds))


@contextmanager
def jumping(offset: Path) -> Iterator[None]:
    """Let the clock jump several times a second."""
    chance, ended = Random(0), threading.Event()

    def jump() -> None:
        while not ended.wait(chance.uniform(0.02, 0.2)):
            set_clock(offset, chance.choice(JUMPS_S))

    thread = threading.Thread(target=jump)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


def pause_until_ended(server: RunningServer, operation: str) -> int:
    """Pause and resume an operation again and again, until it has ended or often enough; return how often."""
    for count in range(MAX_PAUSES):
        server.wait_for(operation, "running", *ENDS)
        server.client.post(f"/operations/{operation}/commands", json={"type": "pause"})
        if server.wait_for(operation, "paused", *ENDS)["state"] != "paused":
            return count
        server.client.post(f"/operations/{operation}/commands", json={"type": "resume"})
    return MAX_PAUSES
