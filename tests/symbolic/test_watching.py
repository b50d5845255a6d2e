"""`skillc test --watch` runs the tests again when a file changes; a cell without bodies is served like any other."""

from __future__ import annotations

import json
import queue
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import IO

import pytest

from running_cells.yard import write_yard
from server.running import serving, wait_until
from symbolic.ward import write_ward
from waiting import LONG_S

TEST = """use skiros
import "terms.skill"
prefix lab: <http://example.org/lab#>

test a_tray_moves {
    scene  "ward.ttl"
    do     Carry(cart: lab:Cart-1, tray: lab:Tray-1, to: lab:Kitchen)
    expect lab:Kitchen contain lab:Tray-1
}
"""


class Lines:
    """The lines of a process, one by one."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._lines = queue.Queue[str]()
        assert process.stdout is not None
        threading.Thread(target=self._read, args=(process.stdout,), daemon=True).start()

    def until(self, words: str) -> str:
        """Return the text up to a line that holds these words."""
        found = ""
        while words not in found:
            found += self._lines.get(timeout=LONG_S)
        return found

    def _read(self, stream: IO[str]) -> None:
        for line in stream:
            self._lines.put(line)


@pytest.fixture
def watched(tmp_path: Path) -> Iterator[tuple[Path, subprocess.Popen[str]]]:
    folder = write_ward(tmp_path)
    (folder / "tests.skill").write_text(TEST)
    command = [sys.executable, "-u", "-m", "skillc", "test", "--watch"]
    process = subprocess.Popen(
        command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
    )
    yield folder, process
    process.kill()
    process.wait()


@pytest.mark.slow
def test_tests_are_run_again_after_a_change(watched: tuple[Path, subprocess.Popen[str]]) -> None:
    folder, process = watched
    lines = Lines(process)
    assert "1 test, all passed" in lines.until("waiting for changes")
    (folder / "tests.skill").write_text(TEST.replace("expect lab:Kitchen", "expect lab:Ward-2"))
    assert "error[test-failed]" in lines.until("waiting for changes")
    (folder / "tests.skill").write_text("test broken {")
    assert "unclosed" in lines.until("waiting for changes")
    (folder / "tests.skill").write_text(TEST)
    assert "1 test, all passed" in lines.until("waiting for changes")
    process.send_signal(signal.SIGINT)
    assert process.wait(LONG_S) == 0


def write_both(folder: Path) -> None:
    """Write a yard, which each test server serves, and the ward."""
    write_yard(folder)
    write_ward(folder)


@pytest.mark.slow
def test_a_served_cell_has_no_bodies(tmp_path: Path) -> None:
    options = ("--backend", "symbolic", "--cell", "ward/ward.ttl")
    libraries = (".", "ward")
    with serving(tmp_path, options=options, libraries=libraries, write=lambda folder, _: write_both(folder)) as running:
        cell = wait_until(lambda: running.client.get("/cells/ward").json(), lambda it: it["state"] == "operational")
        assert cell["backend"] == "symbolic" and cell["paceable"]
        answer = running.client.post("/cells/ward/operations", json={"task": "deliver"}).json()
        ended = running.wait_for(answer["id"], "succeeded", "failed")
        assert ended["state"] == "succeeded" and not ended["verified"]
        facts = json.dumps(running.client.get("/cells/ward/world").json())
        assert "Kitchen" in facts
