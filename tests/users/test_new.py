"""`skillc new`: what it makes has no mistake, and a name that cannot be a library's is refused in words."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc


def call(*arguments: str) -> Result:
    return CliRunner().invoke(skillc, arguments)


def test_a_new_library_checks_and_compiles_without_a_word(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    made = call("new", "shelves/wipe_window")
    assert made.exit_code == 0, made.output
    folder = tmp_path / "shelves/wipe_window"
    written = {path.relative_to(tmp_path).as_posix() for path in folder.rglob("*") if path.is_file()}
    assert set(made.stdout.splitlines()) == written
    assert {path.rsplit("/", 1)[-1] for path in written} >= {"wipe_window.skill", "check.yml", ".gitignore"}
    monkeypatch.chdir(folder)
    checked = call("check", ".", "--scene", "cell.ttl", "--format", "concise")
    assert (checked.exit_code, checked.stdout) == (0, "")
    assert call("fmt", "--check", ".").exit_code == 0
    compiled = call("compile", ".", "-o", "build")
    assert compiled.exit_code == 0, compiled.output
    assert "build/trees/WipeWindow.xml" in compiled.stdout.splitlines()


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("Wipe-Window", "try `wipe_window`"),
        ("2fast", "starting with a letter"),
        ("pick", "`Pick`"),
        ("seq", "cannot be called `seq`"),
        ("wiping", "prefix of a vocabulary"),
        ("lab", "prefix of a vocabulary"),
        ("taken", "already exists"),
        (".", "already exists"),
    ],
)
def test_a_name_that_cannot_be_is_refused(
    name: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "taken").mkdir()
    refused = call("new", name)
    assert refused.exit_code == 2
    assert words in refused.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]


@pytest.mark.sim
def test_a_new_library_lives(tmp_path: Path) -> None:
    command = str(Path(sys.executable).with_name("skillc"))
    life = "skillc new press_bell && cd press_bell && skillc check . && skillc compile . -o build"
    life = f"{life} && skillc run .:press_bell && {sys.executable} -m pytest -q -p no:cacheprovider"
    shell = ["sh", "-ec", life.replace("skillc ", f"{command} ")]
    lived = subprocess.run(shell, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert lived.returncode == 0, lived.stdout + lived.stderr
    assert "3 passed" in lived.stdout
