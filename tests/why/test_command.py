"""`skillc why` as a user meets it: folders without a recording, broken recordings, JSON, exit codes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from selection.library import call, library, scene
from skillc.cli.main import skillc
from skillc_model.conditions import Individual
from skillc_runtime.world.state.model import WorldModel
from tree.stage import Stage
from why.stories import events_of, written
from world.lab import iri

NOTE = b'{"run":"x","sequence":1,"wall_time_ns":0,"event":{"type":"note","time":0.0,"message":"hm"}}\n'
PICK = call("Pick", arm=Individual(iri("arm")), object=Individual(iri("eraser")))


def why(*arguments: object) -> Result:
    result = CliRunner().invoke(skillc, ["why", *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


@pytest.fixture
def run(tmp_path: Path) -> Path:
    return written(tmp_path / "run", events_of(PICK, library(), Stage(WorldModel(scene()))))


def test_the_folder_and_the_file_of_a_run_are_explained(run: Path) -> None:
    folder, file = why(run), why(run / "events.jsonl")
    assert folder.exit_code == file.exit_code == 0 and not folder.stderr
    assert folder.stdout.partition("\n\nAsk")[0] == file.stdout.partition("\n\nAsk")[0]


def test_json_has_the_run_or_the_answer(run: Path) -> None:
    story, answer = (json.loads(why(run, *each, "--json").stdout) for each in ((), ("Pick.gripper",)))
    (step,) = story["attempts"][0]["steps"]
    assert (story["status"], step["number"], step["bindings"]["gripper"]["label"]) == ("failed", "1", "t:gripper")
    assert (answer["parameter"], answer["calls"]) == ("gripper", [step])


def test_a_question_about_nothing_is_a_usage_error(run: Path) -> None:
    result = why(run, "Wipe")
    assert result.exit_code == 2 and not result.stdout
    assert "nothing in this run is called `Wipe`" in result.stderr


def test_a_run_that_was_cut_short_is_explained_as_far_as_it_goes(run: Path) -> None:
    file = run / "events.jsonl"
    whole = file.read_bytes()
    first = whole.index(b"\n") + 1
    lengths = range(first, len(whole), 97)
    assert len(lengths) > 10
    for length in lengths:
        file.write_bytes(whole[:length])
        result = why(run)
        assert result.exit_code == 0
        assert "before the task does" in result.stdout
        assert ("is incomplete" in result.stderr) == (whole[length - 1 : length] != b"\n")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "has no events of a task"),
        (b'{"type": "task-start', "has no events of a task"),
        (b'{"hello": 1}\n', ":1: this is not an event of skillc"),
        (b'["task-started"]\n', ":1: this is not an event of skillc"),
        (b"\xff\xfe\x00\n", ":1: this is not an event of skillc"),
        (b'%s{"type":"moon"}\n' % NOTE, ":2: this is not an event of skillc"),
        (NOTE + NOTE, ":2: event 2 of x is expected here, not event 1 of x"),
        (b'{"event":{"type":"task-started","format":99},"run":"x"}\n', ":1: a newer skillc wrote this (format 99"),
        (b'{"type":"task-started","time":0.0,"format":4,"task":"x"}\n', ":1: an older skillc wrote this (format 4"),
    ],
)
def test_a_file_that_is_no_recording_is_refused(tmp_path: Path, content: bytes, message: str) -> None:
    (tmp_path / "events.jsonl").write_bytes(content)
    result = why(tmp_path)
    assert result.exit_code == 1 and not result.stdout
    assert result.stderr.startswith("error: ") and message in result.stderr and result.stderr.count("\n") == 1


def test_a_folder_without_a_recording_is_refused_with_what_to_do(tmp_path: Path, run: Path) -> None:
    empty = tmp_path / "empty"
    empty.mkdir()
    (tmp_path / "folder" / "events.jsonl").mkdir(parents=True)
    for folder, message in (
        (tmp_path / "nowhere", "`skillc run TASK --out DIR` records a run"),
        (empty, "has no events.jsonl: `skillc run TASK --out DIR` writes it"),
        (tmp_path, f"there are recordings in {tmp_path / 'folder'}, {run}"),
        (tmp_path / "folder", "events.jsonl is a folder"),
    ):
        result = why(folder)
        assert result.exit_code == 1 and not result.stdout
        assert message in result.stderr


def test_a_number_of_thousands_of_parts_is_answered(run: Path) -> None:
    asked = why(run, "1" + ".1" * 5000)
    assert asked.exit_code != 0
    assert "there is no step 1.1;" in asked.stderr or "no skill was called in step 1" in asked.stderr
