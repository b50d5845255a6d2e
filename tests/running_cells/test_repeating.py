"""Every operation that has its cell for itself is repeated from its recording, whatever the cell did before."""

from __future__ import annotations

import shutil
from pathlib import Path

import msgspec
import pytest
from msgspec import structs

from running_cells.test_operations import run_all
from running_cells.test_reality import BOARD, ONE_PART, SORTING, TABLE, find_task, make_settings
from running_cells.yard import write_yard
from skillc.cells.host import CellHost
from skillc.cells.opening import open_cell
from skillc.cells.operations.recording_files import recording_file
from skillc.cells.settings import CellSettings
from skillc.contract.messages import Edit
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc.errors import ServiceError
from skillc.services.project.backends import BackendName
from skillc.services.replaying.check import ReplayCheck, check_run
from skillc.services.replaying.report import report_recorded
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.devices.disturbances import MoveThing, PushArm
from skillc_runtime.recording.mcap.contents import START
from skillc_runtime.recording.mcap.reader import read_recording
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.recording.run_start import StartError, decode_start
from skillc_runtime.store.change_json import decode_changes

ARM, PART = "lab:Arm-1", "lab:Part-A"


def run_for(host: CellHost, ticks: int) -> None:
    """Let a number of ticks happen."""
    end = host.loop.ticks + ticks
    while host.loop.ticks < end:
        if not host.tick():
            host.loop.wait(0.1)


def stop_after(host: CellHost, operation: str, request: OperationRequest, ticks: int) -> OperationStatus:
    """Carry out an operation for some ticks, and stop it."""
    host.submit(operation, request)
    run_for(host, ticks)
    host.stop(operation, "enough")
    (ended,) = run_all(host)
    assert ended.state == "stopped"
    return ended


def check(settings: CellSettings, operation: str) -> ReplayCheck:
    return check_run(recording_file(Path(settings.folder), operation), None, SilentReporter())


def assert_repeated(settings: CellSettings, *operations: str) -> None:
    for each in operations:
        found = check(settings, each)
        assert found.ok and found.repeated == found.events, (each, found.impossible, found.note, found.difference)


@pytest.mark.parametrize(
    ("case", "request_", "backend", "ticks"),
    [
        (SORTING, ONE_PART, "kinematic", (300, 700)),
        pytest.param(SORTING, find_task(SORTING), "mujoco", (900, 1500), marks=pytest.mark.sim),
        pytest.param(TABLE, find_task(TABLE), "mujoco", (900, 1500), marks=pytest.mark.sim),
        pytest.param(BOARD, find_task(BOARD), "mujoco", (900, 1500), marks=pytest.mark.sim),
    ],
)
def test_later_operations_are_repeated_and_get_a_report(
    case: tuple[str, str, str],
    request_: OperationRequest,
    backend: BackendName,
    ticks: tuple[int, int],
    tmp_path: Path,
) -> None:
    settings = make_settings(tmp_path, case, backend)
    with open_cell(settings, SilentReporter()) as host:
        for number, each in enumerate(ticks):
            stop_after(host, f"op-{number}", request_, each)
        began_s = host.loop.backend.clock.now
        host.submit("last", request_)
        (ended,) = run_all(host)
        took_s = host.loop.backend.clock.now - began_s
    assert ended.state == "succeeded" and began_s > 0.00625 * sum(ticks)
    assert_repeated(settings, "op-0", "op-1", "last")
    recording = recording_file(Path(settings.folder), "last")
    result = report_recorded(
        recording, None, RunSpec(out=str(tmp_path / "report"), film=False), SilentReporter()
    ).result
    assert (result.status, result.verified) == ("succeeded", ended.verified)
    assert result.sim_time_s == pytest.approx(took_s) and (tmp_path / "report" / "report.html").exists()


def test_facts_that_were_only_assumed_before_are_so_when_repeated(tmp_path: Path) -> None:
    settings = write_yard(tmp_path, takes_ms=5)
    with open_cell(settings, SilentReporter()) as host:
        for number in range(3):
            goal = f"lab:Goal contain lab:crate-{number} and lab:Goal contain lab:crate-0"
            host.submit(f"op-{number}", OperationRequest(goal=goal))
            (ended,) = run_all(host)
            assert ended.state == "succeeded" and ended.verified is False
    assert_repeated(settings, "op-0", "op-1", "op-2")
    start = decode_start(read_recording(recording_file(Path(settings.folder), "op-2")).attachments[START])
    written = [decode_changes(each.changes) for each in start.writes if each.evidence == "assumed"]
    assert len(written) == 4, "two crates were loaded and unloaded before"


@pytest.mark.parametrize("decision", ["retry", "replan"])
def test_what_goes_on_after_a_crash_is_repeated(decision: str, tmp_path: Path) -> None:
    settings = make_settings(tmp_path, SORTING, "kinematic")
    with open_cell(settings, SilentReporter()) as host:
        stop_after(host, "before", ONE_PART, 300)
        host.submit("first", ONE_PART)
        run_for(host, 700)
        shutil.copytree(settings.folder, tmp_path / "image")
    settings = structs.replace(settings, folder=str(tmp_path / "image"))
    with open_cell(settings, SilentReporter()) as again:
        request = msgspec.convert({"continues": "first", "decision": decision, "why": "go on"}, OperationRequest)
        again.submit("again", request)
        (ended,) = run_all(again)
        assert ended.state == "succeeded", ended.reason
    assert_repeated(settings, "before", "again")


def test_edits_and_disturbances_are_repeated(tmp_path: Path) -> None:
    settings = make_settings(tmp_path, SORTING, "kinematic")
    with open_cell(settings, SilentReporter()) as host:
        stop_after(host, "before", ONE_PART, 300)
        host.disturb(MoveThing(PART, (0.01, 0.0, 0.0)), "bo")
        host.edit(Edit(edits=("lab:spare a skiros:Product",), who="bo", why="it came"))
        host.submit("disturbed", ONE_PART)
        run_for(host, 200)
        host.edit(Edit(edits=("not lab:spare",), who="bo", why="it is gone"))
        host.disturb(PushArm(ARM, (5.0, 0.0, 0.0)), "bo")
        run_all(host)
    assert_repeated(settings, "before", "disturbed")


def test_who_is_not_alone_is_not_repeated_and_why_is_said(tmp_path: Path) -> None:
    settings = write_yard(tmp_path, takes_ms=5)
    with open_cell(settings, SilentReporter()) as host:
        host.submit("one", OperationRequest(call="Load(cart: lab:Cart-1, crate: lab:crate-0)"))
        run_for(host, 1)
        host.submit("two", OperationRequest(goal="lab:Goal contain lab:crate-0"))
        run_all(host)
        host.submit("three", OperationRequest(goal="lab:Goal contain lab:crate-1"))
        run_all(host)
    assert check(settings, "one").note == "the operation two went on in the same cell"
    assert check(settings, "two").note == "the operation one went on in the cell when it began"
    assert check(settings, "one").repeated is None and check(settings, "one").ok
    assert_repeated(settings, "three")
    recording = recording_file(tmp_path / "state", "one")
    with pytest.raises(ServiceError, match="the operation two went on in the same cell, so it cannot be repeated"):
        report_recorded(recording, None, RunSpec(out=str(tmp_path / "report"), film=False), SilentReporter())
    assert not (tmp_path / "report").exists()


def test_a_push_that_goes_on_is_said(tmp_path: Path) -> None:
    settings = make_settings(tmp_path, SORTING, "kinematic")
    with open_cell(settings, SilentReporter()) as host:
        host.disturb(PushArm(ARM, (1.0, 0.0, 0.0), 60.0), "bo")
        stop_after(host, "pushed", ONE_PART, 300)
    assert check(settings, "pushed").note == "the cell was being disturbed when it began"


@pytest.mark.parametrize("content", [b"", b"\x00", msgspec.msgpack.encode({"facts": "no triples"})])
def test_a_start_that_cannot_be_read_is_refused(content: bytes) -> None:
    with pytest.raises(StartError):
        decode_start(content)
