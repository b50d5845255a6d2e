"""Each operation of a server has a recording, which clients read."""

from __future__ import annotations

import json
import os
import signal
from contextlib import closing
from pathlib import Path

import pytest
from click.testing import CliRunner
from mcap.reader import make_reader

import skillc
from server.running import RunningServer, find_cell_process, wait_until
from skillc.cells.journal.reading import JournalReader
from skillc.cells.opening import open_cell
from skillc.cells.settings import CellSettings
from skillc.cli.main import skillc as program
from skillc.contract.operation import OperationRequest
from skillc.services.library.files import SHIPPED
from skillc.services.reporting.reporter import SilentReporter
from skillc_ontology import catalogue
from skillc_runtime.recording.events import Note
from skillc_runtime.recording.mcap.reader import read_recording
from waiting import LONG_S

CARRY = {"task": "carry", "arguments": {"crate": "lab:crate-0", "to": "lab:Goal"}}


def test_the_recording_of_an_operation_has_its_events(server: RunningServer, tmp_path: Path) -> None:
    server.put_back()
    server.client.put("/cells/yard/pace", json={"factor": None})
    operation = server.submit(**CARRY)["id"]
    server.wait_for(operation, "succeeded")
    answer = server.client.get(f"/operations/{operation}/recording")
    assert answer.status_code == 200 and answer.headers["content-type"] == "application/octet-stream"
    assert answer.headers["content-disposition"] == f'attachment; filename="{operation}.mcap"'
    file = tmp_path / "carry.mcap"
    file.write_bytes(answer.content)
    with file.open("rb") as content:
        found = [json.loads(message.data) for _, _, message in make_reader(content, validate_crcs=True).iter_messages()]
    assert found == server.client.get(f"/operations/{operation}/events").json()
    recorded = read_recording(file)
    assert not recorded.note and recorded.metadata["run"] == operation
    assert json.loads(recorded.attachments["settings.json"])["owner"] == "admin"
    assert server.client.get("/operations/nothing/recording").status_code == 404


def test_clients_write_it_to_a_file(server: RunningServer, tmp_path: Path) -> None:
    server.put_back()
    url = f"http://127.0.0.1:{server.port}"
    with skillc.connect(url, state=server.folder / "served") as connected:
        operation = connected.cell().start("carry", arguments=CARRY["arguments"], approve=True)
        operation.wait_for_pause()
        wait_until(lambda: read_recording(operation.recording(tmp_path / "a.mcap")).envelopes, bool)
        so_far = skillc.open_run(tmp_path / "a.mcap")
        assert so_far.status == "interrupted" and so_far.events[0].run == operation.id
        operation.stop()
        operation.wait(LONG_S)
        run = skillc.open_run(operation.recording(tmp_path / "b.mcap"))
        assert run.status == "stopped" and run.events == tuple(operation.events()) and not run.messages
    done = CliRunner().invoke(
        program,
        [
            "logs",
            operation.id,
            "--recording",
            str(tmp_path / "c.mcap"),
            "--server",
            url,
            "--token-file",
            str(server.folder / "served/admin.token"),
        ],
    )
    assert done.exit_code == 0 and f"the recording of {operation.id} is in {tmp_path / 'c.mcap'}" in done.stderr
    assert (tmp_path / "c.mcap").read_bytes() == (tmp_path / "b.mcap").read_bytes()
    assert sorted(each.name for each in tmp_path.iterdir()) == ["a.mcap", "b.mcap", "c.mcap"]


def test_recordings_are_pruned_with_their_operations_and_backed_up(server: RunningServer, tmp_path: Path) -> None:
    folder = server.folder / "served"
    operation = server.submit(task="carry_all", approve=True)["id"]
    server.wait_for(operation, "planned")
    file = folder / "cells/yard/recordings" / f"{operation}.mcap"
    server.client.post(f"/operations/{operation}/stop", json={})
    server.wait_for(operation, "stopped")
    assert server.client.get(f"/operations/{operation}/recording").status_code == 200
    state = [["state", "backup", str(tmp_path / "copy")], ["state", "prune", "--larger-than", "1kB"]]
    for each in state:
        assert file.exists()
        assert CliRunner().invoke(program, [*each, "--state", str(folder)]).exit_code == 0
    assert not file.exists() and server.client.get(f"/operations/{operation}/recording").status_code == 404
    assert not read_recording(tmp_path / "copy/cells/yard/recordings" / file.name).note


def settings_of(folder: Path) -> CellSettings:
    """Return a cell in which a button can be pressed."""
    return CellSettings(
        name="cell",
        scene=str(catalogue.scene_path("ur5e_button")),
        library=str(SHIPPED / "contact"),
        folder=str(folder),
        backend="kinematic",
    )


def test_an_operation_whose_recording_cannot_be_written_goes_on(tmp_path: Path) -> None:
    (tmp_path / "recordings").write_text("not a folder")
    with open_cell(settings_of(tmp_path), SilentReporter()) as host:
        host.submit("press-1", OperationRequest(task="press_button", approve=True))
        host.stop("press-1", "enough")
        wait_until(lambda: (host.tick(), host.take_changed())[1], lambda it: it and it[0].state == "stopped")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a disk that is always full is needed")
def test_an_operation_says_that_its_recording_has_ended_and_goes_on(tmp_path: Path) -> None:
    settings = settings_of(tmp_path)
    (tmp_path / "recordings").mkdir()
    (tmp_path / "recordings/press-1.mcap").symlink_to("/dev/full")
    with open_cell(settings, SilentReporter()) as host, closing(JournalReader(settings.journal)) as journal:

        def read_notes() -> list[str]:
            host.tick()
            host.take_changed()
            events = (each.event for each in journal.envelopes("press-1"))
            return [each.message for each in events if isinstance(each, Note)]

        host.submit("press-1", OperationRequest(task="press_button", approve=True))
        (note,) = wait_until(read_notes, bool)
        assert note.startswith("warning: ") and note.endswith("press-1.mcap is incomplete: No space left on device")
        wait_until(lambda: (host.tick(), host.loop.runs[0].state)[1], lambda state: state == "planned")


@pytest.mark.sim
def test_it_has_the_signals_while_an_operation_runs(tmp_path: Path) -> None:
    with open_cell(settings_of(tmp_path), SilentReporter()) as host:
        host.submit("press-1", OperationRequest(task="press_button"))
        while host.loop.runs:
            if not host.tick():
                host.loop.wait(0.01)
            host.take_changed()
    recorded = read_recording(tmp_path / "recordings/press-1.mcap")
    signals = recorded.signals()
    assert len(signals.time_s) > 1000 and recorded.envelopes[-1].cell_time_s - signals.time_s[-1] < 0.05


@pytest.mark.sim
def test_the_recording_of_a_cell_that_was_killed_can_be_read(server: RunningServer, tmp_path: Path) -> None:
    server.put_back(pace=0.2)
    operation = server.submit(task="carry_all")["id"]
    server.wait_for(operation, "running")
    (written,) = (server.folder / "served").rglob(f"{operation}.mcap")
    wait_until(lambda: len(read_recording(written).envelopes), lambda count: count > 3)
    os.kill(find_cell_process(server), signal.SIGKILL)
    shown = f"/operations/{operation}"
    wait_until(lambda: server.client.get(shown).json().get("state"), lambda state: state == "interrupted")
    server.wait_ready()
    file = tmp_path / "killed.mcap"
    file.write_bytes(server.client.get(f"/operations/{operation}/recording").content)
    recorded = read_recording(file)
    assert "was cut off; its last event is at" in recorded.note
    found = server.client.get(f"/operations/{operation}/events").json()
    assert [each.sequence for each in recorded.envelopes] == list(range(1, len(recorded.envelopes) + 1))
    assert 3 < len(recorded.envelopes) < len(found)
