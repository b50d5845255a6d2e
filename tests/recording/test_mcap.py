"""Recordings as MCAP files: they have what happened, foreign readers read them, and damage is told in a sentence."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.reader import make_reader

import skillc
from recording.runs import CONTENTS, EVENTS, publish, write_recording
from skillc.cli.main import skillc as program
from skillc_model.codec import loads
from skillc_runtime.recording.mcap import recording_file
from skillc_runtime.recording.mcap.contents import RunContents
from skillc_runtime.recording.mcap.reader import read_recording
from skillc_runtime.recording.mcap.recording_file import RecordingFile
from skillc_runtime.recording.mcap.signal_block import QUANTA, SignalBlock, decode_columns, encode_columns
from skillc_runtime.recording.reader import TraceError
from waiting import LONG_S, wait_until


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> skillc.Run:
    """A run with all that is recorded, shared by tests that only read."""
    folder = tmp_path_factory.mktemp("run")
    return skillc.run("contact:press_button", backend="kinematic", out=folder, signals="csv", film=False)


@pytest.mark.sim
def test_the_recording_has_the_events_and_what_the_run_was_made_of(run: skillc.Run) -> None:
    assert run.recording is not None
    assert not any("incomplete" in each for each in run.messages)
    recorded = read_recording(run.recording)
    assert recorded.envelopes == run.events and not recorded.note
    assert recorded.metadata["run"] == run.events[0].run and recorded.metadata["backend"] == "kinematic"
    library = loads(recorded.attachments["library.json"], "library.json")
    assert library.hash == recorded.metadata["library_hash"]
    assert b"Button-1" in recorded.attachments["scene.ttl"]


@pytest.mark.sim
def test_a_foreign_reader_finds_no_fault_in_it(run: skillc.Run) -> None:
    assert run.recording is not None
    with run.recording.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        events = [json.loads(message.data) for _, channel, message in reader.iter_messages(["/events"])]
        kinds = {(channel.topic, schema.name) for schema, channel, _ in reader.iter_messages() if schema is not None}
        summary = reader.get_summary()
    assert [each["sequence"] for each in events] == list(range(1, len(run.events) + 1))
    assert {("/events", "skillc.Envelope"), ("/signals", "skillc.SignalBlock")} <= kinds
    assert summary is not None and summary.statistics is not None
    assert summary.statistics.attachment_count == 3


@pytest.mark.sim
def test_signals_have_each_control_period_and_the_values_of_those_that_are_sampled_in_ticks(run: skillc.Run) -> None:
    assert run.recording is not None
    fast, slow = read_recording(run.recording).signals(), run.to_frame("signals")
    steps = np.diff(fast.time_s)
    assert np.allclose(steps, 0.002, atol=1e-9), "one sample in each period, none is missing"
    assert fast.time_s[-1] > 0.98 * slow.index[-1]
    names = [each.column for each in fast.signals if each.column in slow.columns and "joint" in each.column]
    assert len(names) >= 6
    for name in names:
        # A tick ends after the periods in it: its sample is that of the last of them.
        nearest = np.searchsorted(fast.time_s, slow.index.to_numpy() - 0.0021).clip(0, len(fast.time_s) - 1)
        assert np.abs(fast.column(name)[nearest] - slow[name].to_numpy()).max() < 1e-4, name


@pytest.mark.sim
def test_the_file_alone_explains_itself(run: skillc.Run, tmp_path: Path) -> None:
    assert run.recording is not None
    file = tmp_path / "elsewhere.mcap"
    shutil.copy(run.recording, file)
    again = skillc.open_run(file)
    assert again.events == run.events and again.status == "succeeded" and again.recording == file
    assert again.why("1") == run.why("1")
    assert len(again.to_frame("signals")) == len(read_recording(file).signals().time_s)
    answer = CliRunner().invoke(program, ["why", str(file)])
    assert answer.exit_code == 0 and "press_button: finished" in answer.stdout and not answer.stderr


@pytest.mark.sim
def test_a_run_that_is_killed_can_be_read_up_to_the_last_chunk(tmp_path: Path) -> None:
    options = ["--no-film", "--out", str(tmp_path), "--pace", "real"]
    start = [sys.executable, "-m", "skillc", "run", "contact:press_button", *options]
    file = tmp_path / "recording.mcap"
    with subprocess.Popen([*start, "--quiet"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        wait_until(lambda: file.exists() and _count_samples(file) > 1000, 0.1)
        process.kill()
    recorded = read_recording(file)
    assert recorded.is_truncated and "was cut off; its last event is at" in recorded.note
    assert recorded.signals().time_s[-1] > 0.9
    answer = CliRunner().invoke(program, ["why", str(file)])
    assert answer.exit_code == 0 and "was cut off" in answer.stderr and "before the task does" in answer.stdout


def _count_samples(file: Path) -> int:
    try:
        return len(read_recording(file).signals().time_s)
    except TraceError:
        return 0


def test_events_are_read_back(tmp_path: Path) -> None:
    assert write_recording(tmp_path / "a.mcap").problem is None
    recorded = read_recording(tmp_path / "a.mcap")
    assert tuple(each.event for each in recorded.envelopes) == EVENTS
    assert recorded.metadata == {"task": "rest"} and recorded.attachments == {"library.json": b"{}"}
    assert not recorded.note and recorded.signals().rows.shape == (0, 0)


def test_a_file_that_was_cut_off_has_the_events_before(tmp_path: Path) -> None:
    write_recording(tmp_path / "a.mcap")
    whole, file, lengths = (tmp_path / "a.mcap").read_bytes(), tmp_path / "b.mcap", set()
    for length in range(0, len(whole), 7):
        file.write_bytes(whole[:length])
        try:
            recorded = read_recording(file)
        except TraceError as error:
            assert length < 200 and "is not a recording" in str(error)
        else:
            assert recorded.note and [each.event for each in recorded.envelopes] == list(
                EVENTS[: len(recorded.envelopes)]
            )
            lengths.add(len(recorded.envelopes))
    assert lengths == {0, len(EVENTS)}


@settings(max_examples=60, deadline=None)
@given(place=st.floats(0.0, 1.0, exclude_max=True), flip=st.integers(1, 255))
def test_a_damaged_file_is_a_sentence_or_has_the_right_events(
    place: float, flip: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = tmp_path_factory.mktemp("damaged")
    write_recording(folder / "a.mcap")
    content = bytearray((folder / "a.mcap").read_bytes())
    content[int(place * len(content))] ^= flip
    (folder / "b.mcap").write_bytes(content)
    try:
        recorded = read_recording(folder / "b.mcap")
        recorded.signals()
    except TraceError as error:
        assert str(folder / "b.mcap") in str(error) and "\n" not in str(error)
    else:
        found = [each.event for each in recorded.envelopes]
        assert found == list(EVENTS[: len(found)])


@pytest.mark.parametrize("content", [b"", b"\x89MCAP0\r\n", b"hello", b"\0" * 500, b"\x89MCAP0\r\n" + b"\xff" * 500])
def test_something_else_is_refused_in_a_sentence(content: bytes, tmp_path: Path) -> None:
    file = tmp_path / "other.mcap"
    file.write_bytes(content)
    answer = CliRunner().invoke(program, ["why", str(file)])
    assert answer.exit_code == 1 and not answer.stdout
    assert answer.stderr.startswith(f"error: {file} ") and answer.stderr.count("\n") == 1


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a disk that is always full is needed")
def test_a_full_disk_ends_the_recording_and_not_the_run() -> None:
    assert write_recording(Path("/dev/full")).problem == "/dev/full is incomplete: No space left on device"


@pytest.mark.slow
def test_a_disk_that_does_not_keep_up_ends_the_recording_and_not_the_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recording_file, "MAX_EVENTS", 500)
    published = threading.Event()

    def describe_late() -> RunContents:
        published.wait(LONG_S)
        return CONTENTS

    recording = RecordingFile(tmp_path / "a.mcap", describe_late)
    publish(EVENTS * 20, recording)
    published.set()
    recording.close()
    assert recording.problem is not None and "the disk is too slow" in recording.problem


ROWS = st.integers(1, 40).flatmap(
    lambda rows: st.lists(
        st.lists(st.floats(-1e6, 1e6) | st.just(float("nan")), min_size=rows, max_size=rows), min_size=1, max_size=4
    )
)


@given(ROWS)
def test_signals_are_kept_within_half_a_step(columns: list[list[float]]) -> None:
    rows = np.array(columns).T
    encoded = encode_columns(rows, ["rad"] * rows.shape[1])
    decoded = decode_columns(SignalBlock(0, 1000, len(rows), encoded))
    assert np.array_equal(np.isnan(decoded), np.isnan(rows))
    assert np.nanmax(np.abs(decoded - rows), initial=0.0) <= 0.5001 * QUANTA["rad"]
