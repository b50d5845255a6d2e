"""A server that is asked to end lets its cells come to rest first, whatever asks it."""

from __future__ import annotations

import signal
from contextlib import closing
from pathlib import Path

import pytest

from server.running import serving
from skillc.cells.journal.reading import JournalReader
from skillc_runtime.recording.events import TaskEnded


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_operations_have_an_end_and_the_exit_code_is_0(tmp_path: Path, number: signal.Signals) -> None:
    with serving(tmp_path, takes_ms=2000) as server:
        server.client.put("/cells/yard/pace", json={"factor": 1.0})
        operation = server.submit(task="carry_all")["id"]
        server.wait_for(operation, "running")
        server.process.send_signal(number)
        said = server.process.communicate(timeout=60.0)[1]
    assert server.process.returncode == 0 and f"ended by {number.name}: all devices are at rest".encode() in said
    with closing(JournalReader(tmp_path / "served/cells/yard/journal.sqlite")) as reader:
        found, events = reader.find(operation), reader.envelopes(operation)
    assert found is not None and found.ended is not None and found.ended.state == "interrupted"
    assert isinstance(events[-1].event, TaskEnded)
