"""Whatever a path leads to, a command that is given it ends, and says what it is."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc

LONG = "x" * 300
SKILL = 'skill Rest { noplan }\nimpl waiting of Rest { run python "skillc.primitives:StandIn" }\n'
ODD = {
    "pipe": "pipe is not a regular file",
    "circle": "circle is a broken link",
    "folder": "folder is a folder",
    LONG: "cannot be opened: File name too long",
    "nowhere": "there is no file nowhere",
}


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    os.mkfifo("pipe")
    Path("circle").symlink_to("circle")
    Path("folder").mkdir()
    Path("a.skill").write_text(SKILL)
    Path("recording").mkdir()
    os.mkfifo("recording/events.jsonl")
    return tmp_path


def call(*arguments: str) -> Result:
    result = CliRunner().invoke(skillc, arguments)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


@pytest.mark.parametrize("name", ODD)
@pytest.mark.parametrize(
    "command", [("world",), ("check", "a.skill", "--scene"), ("world", "iiwa_table", "--diff"), ("plan", "--scene")]
)
def test_what_is_no_scene_is_said_to_be_what_it_is(place: Path, command: tuple[str, ...], name: str) -> None:
    more = ("--goal", "x") if command[0] == "plan" else ()
    result = call(*command, name, *more)
    assert (result.exit_code, result.stdout) == (2, "")
    assert ODD[name] in result.stderr


@pytest.mark.parametrize(
    "command",
    [
        ("check", LONG),
        ("fmt", LONG),
        ("plan", f"{LONG}:x"),
        ("new", LONG),
        ("compile", LONG, "-o", "build"),
        ("world", "iiwa_table", "--library", LONG),
        ("why", LONG),
    ],
)
def test_a_name_too_long_for_a_file_is_refused_in_words(place: Path, command: tuple[str, ...]) -> None:
    result = call(*command)
    assert result.exit_code == (1 if command[0] == "why" else 2)
    assert "File name too long" in result.stderr


@pytest.mark.parametrize("name", ["pipe", "recording", "/dev/zero"])
def test_a_recording_is_a_regular_file(place: Path, name: str) -> None:
    result = call("why", name)
    assert result.exit_code == 1
    assert "is not a regular file" in result.stderr


@pytest.mark.parametrize(
    ("scene", "said"),
    [
        ("pipe", 'unreadable-scene]: the scene "pipe" is not a regular file'),
        ("folder", 'unreadable-scene]: the scene "folder" is a folder'),
        (LONG, f'unreadable-scene]: the scene "{LONG}" cannot be opened: File name too long'),
        ("nowhere.ttl", 'unknown-scene]: the scene "nowhere.ttl" is neither beside this file nor shipped'),
    ],
)
def test_a_scene_of_a_task_is_said_to_be_what_it_is(place: Path, scene: str, said: str) -> None:
    Path("a.skill").write_text(f'{SKILL}task rest {{\n    scene "{scene}"\n    do    Rest()\n}}\n')
    result = call("check", "a.skill", "--format", "concise", "--no-cache")
    assert result.exit_code == 1
    assert f"a.skill:4:11: error[{said}" in result.stdout


def test_a_shipped_scene_is_found_beside_a_folder_of_its_name(place: Path) -> None:
    Path("iiwa_table").mkdir()
    assert call("world", "iiwa_table").exit_code == 0
