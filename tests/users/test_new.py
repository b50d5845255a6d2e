"""`skillc new`: what it makes has no mistake, and a name that cannot be a library's is refused in words."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

SKILLC = (sys.executable, "-m", "skillc_runtime")


def call(*command: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)


def test_a_new_library_checks_and_compiles_without_a_word(tmp_path: Path) -> None:
    made = call(*SKILLC, "new", "shelves/wipe_window", cwd=tmp_path)
    assert made.returncode == 0, made.stderr
    folder = tmp_path / "shelves/wipe_window"
    written = {path.relative_to(tmp_path).as_posix() for path in folder.rglob("*") if path.is_file()}
    assert set(made.stdout.splitlines()) == written
    assert {path.rsplit("/", 1)[-1] for path in written} >= {"wipe_window.skill", "check.yml", ".gitignore"}
    checked = call(*SKILLC, "check", ".", "--scene", "cell.ttl", "--format", "concise", cwd=folder)
    assert (checked.returncode, checked.stdout) == (0, "")
    assert call(*SKILLC, "fmt", "--check", ".", cwd=folder).returncode == 0
    compiled = call(*SKILLC, "compile", ".", "-o", "build", cwd=folder)
    assert compiled.returncode == 0, compiled.stderr
    assert "build/trees/WipeWindow.xml" in compiled.stdout.splitlines()


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("Wipe-Window", "try `wipe_window`"),
        ("2fast", "a letter first"),
        ("pick", "`Pick`"),
        ("seq", "cannot be called `seq`"),
        ("wiping", "prefix of a vocabulary"),
        ("lab", "prefix of a vocabulary"),
        ("taken", "exists already"),
        (".", "exists already"),
    ],
)
def test_a_name_that_cannot_be_is_refused(name: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "taken").mkdir()
    refused = call(*SKILLC, "new", name, cwd=tmp_path)
    assert refused.returncode == 2
    assert words in refused.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]


@pytest.mark.sim
def test_a_new_library_lives(tmp_path: Path) -> None:
    skillc = str(Path(sys.executable).with_name("skillc"))
    life = "skillc new press_bell && cd press_bell && skillc check . && skillc compile . -o build"
    life = f"{life} && skillc run .:press_bell && {sys.executable} -m pytest -q -p no:cacheprovider"
    lived = call("sh", "-ec", life.replace("skillc ", f"{skillc} "), cwd=tmp_path)
    assert lived.returncode == 0, lived.stdout + lived.stderr
    assert "3 passed" in lived.stdout
