"""Whatever stands where a file of skills belongs, commands end, and say what it is."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from skillc.cli.main import main

SKILL = 'skill Rest { noplan }\nimpl waiting of Rest { run python "skillc.primitives:StandIn" }\n'


def ended(*arguments: object) -> object:
    with pytest.raises(SystemExit) as raised:
        main([str(each) for each in arguments])
    return raised.value.code


@pytest.mark.parametrize("command", ["check", "fmt"])
@pytest.mark.parametrize("whole", [True, False], ids=["in a folder", "alone"])
@pytest.mark.parametrize("kind", ["pipe", "device", "circle"])
def test_what_is_no_file_is_refused(
    command: str, whole: bool, kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "a.skill"
    if kind == "pipe":
        os.mkfifo(file)
    else:
        file.symlink_to("/dev/zero" if kind == "device" else "a.skill")
    assert ended(command, tmp_path if whole else file) == 2
    assert "a.skill" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["scene.ttl", "vocabulary.ttl"])
def test_a_pipe_beside_the_skills_is_not_read(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.skill").write_text(SKILL + 'task rest {\n    scene "scene.ttl"\n    do    Rest()\n}\n')
    os.mkfifo(tmp_path / name)
    assert ended("check", tmp_path, "--format", "concise") == 1
    assert "scene.ttl" in capsys.readouterr().out


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"], ids=["LF", "CR LF", "CR"])
def test_lines_end_where_editors_end_them(end: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "a.skill"
    text = f"# why \f \x85 \u2028 here\n{SKILL}skill Walk {{\n  in arm: Nowhere\n    noplan }}\n"
    file.write_bytes(text.replace("\n", end).encode())
    assert ended("check", file, "--format", "concise", "--no-cache") == 1
    assert "a.skill:5:11: error[unknown-class]" in capsys.readouterr().out
    assert ended("fmt", file) == 0
    lines = file.read_bytes().decode().split(end)
    assert lines[0] == "# why \f \x85 \u2028 here"
    assert [line.split() for line in lines if "arm" in line] == [["in", "arm:", "Nowhere"]]
