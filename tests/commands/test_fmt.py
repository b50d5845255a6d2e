"""`skillc fmt`: what it writes, prints and returns."""

import os
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc

WILD = "## Point.\nskill  Point{in arm:  ArmDevice   # which\nnoplan}\n"
TAME = "## Point.\nskill Point {\n    in   arm: ArmDevice  # which\n    noplan\n}\n"
BROKEN = "skill Point {\n    in arm ArmDevice\n}\n"


def run(*arguments: object, text: str | bytes | None = None) -> Result:
    result = CliRunner().invoke(skillc, ["fmt", *map(str, arguments)], input=text)
    assert result.exception is None or isinstance(result.exception, SystemExit)
    return result


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "inner").mkdir()
    (tmp_path / "wild.skill").write_text(WILD)
    (tmp_path / "inner" / "tame.skill").write_text(TAME)
    return tmp_path


def test_the_files_of_the_current_folder_are_written_and_named(folder: Path) -> None:
    inode = (folder / "inner" / "tame.skill").stat().st_ino
    result = run()
    assert (result.exit_code, result.stdout, result.stderr) == (0, "", "formatted wild.skill\n")
    assert (folder / "wild.skill").read_text() == TAME
    assert (folder / "inner" / "tame.skill").stat().st_ino == inode
    assert run().stderr == "2 files already formatted\n"
    assert sorted(path.name for path in folder.iterdir()) == ["inner", "wild.skill"]


def test_check_lists_files_and_writes_nothing(folder: Path) -> None:
    result = run("--check")
    assert (result.exit_code, result.stdout.count("\n")) == (1, 1)
    assert result.stdout.startswith("wild.skill:2:1: warning[not-formatted]: ")
    assert (folder / "wild.skill").read_text() == WILD
    assert run("--check", "inner").exit_code == 0
    assert run("--check", "inner").stdout == ""


def test_diff_shows_what_would_change(folder: Path) -> None:
    result = run("--diff")
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.startswith("--- wild.skill\n+++ wild.skill (formatted)\n")
    assert "+    in   arm: ArmDevice  # which\n" in result.stdout
    assert (folder / "wild.skill").read_text() == WILD
    assert run("--diff", "--check").exit_code == 1


def test_standard_input_is_printed_formatted() -> None:
    result = run("-", text=WILD)
    assert (result.exit_code, result.stdout, result.stderr) == (0, TAME, "")
    broken = run("-", "--stdin-filename", "lib/a.skill", text=BROKEN)
    assert (broken.exit_code, broken.stdout) == (1, "")
    assert "lib/a.skill:2:8" in broken.stderr


def test_a_file_with_errors_is_left_alone_and_the_others_are_not(folder: Path) -> None:
    (folder / "broken.skill").write_text(BROKEN)
    result = run()
    assert result.exit_code == 1
    assert "broken.skill:2:8" in result.stderr
    assert (folder / "broken.skill").read_text() == BROKEN
    assert (folder / "wild.skill").read_text() == TAME
    assert run("--check").exit_code == 1


def test_line_ends_mark_mode_and_link_stay(folder: Path) -> None:
    file, link = folder / "real.skill", folder / "link.skill"
    file.write_bytes(b"\xef\xbb\xbf" + WILD.replace("\n", "\r\n").encode())
    file.chmod(0o640)
    link.symlink_to(file)
    assert run(link).exit_code == 0
    assert file.read_bytes() == b"\xef\xbb\xbf" + TAME.replace("\n", "\r\n").encode()
    assert (link.is_symlink(), file.stat().st_mode & 0o777) == (True, 0o640)


def test_nothing_is_lost_when_a_file_cannot_be_written(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    result = run("wild.skill")
    assert (result.exit_code, "No space left" in result.stderr) == (1, True)
    assert (folder / "wild.skill").read_text() == WILD
    assert len(list(folder.iterdir())) == 2


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["missing.skill"], "there is no file or folder missing.skill"),
        (["wiping"], "there is no file or folder wiping"),
        (["-", "wild.skill"], "must be the only path"),
        (["wild.skill", "--stdin-filename", "a.skill"], "requires `-` as the only path"),
    ],
)
def test_a_wrong_command_line(folder: Path, arguments: list[str], words: str) -> None:
    result = run(*arguments)
    assert (result.exit_code, result.stdout) == (2, "")
    assert words in result.stderr
