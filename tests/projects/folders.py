"""A small project in a folder: one skill, one task, the scene of a shipped one."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from click.testing import CliRunner, Result

from skillc.cli.main import skillc

SKILLS = """\
use skiros
import "handling.skill"
prefix lab: <http://example.org/lab#>

class Mark < Product
property isSeen(Mark): Bool

## Hold the eraser.
task hold_eraser {
    scene "iiwa_table.ttl"
    goal  lab:Robotiq-1 contain lab:Eraser-1
}

## Hold it, in the scene of the project.
task hold_here { goal  lab:Robotiq-1 contain lab:Eraser-1 }
"""
MANIFEST = 'name = "sorting"\nversion = "0.1.0"\nscene = "iiwa_table.ttl"\ntask = "hold_eraser"\n'


def write_project(folder: Path, manifest: str = MANIFEST, skills: str = SKILLS) -> Path:
    """Write a project into a new folder and return the folder."""
    folder.mkdir(parents=True)
    (folder / "skillc.toml").write_text(manifest, "utf-8")
    (folder / "tasks.skill").write_text(skills, "utf-8")
    return folder


def call(folder: Path, *arguments: str | Path) -> Result:
    """Run a command in a folder; no exception may leave it."""
    with working_in(folder):
        result = CliRunner().invoke(skillc, [str(each) for each in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def checked(folder: Path, *arguments: str | Path) -> list[dict[str, Any]]:
    """Return the diagnostics of `skillc check` in a folder."""
    result = call(folder, "check", *arguments, "--json", "--no-cache")
    found: list[dict[str, Any]] = json.loads(result.stdout)
    assert result.exit_code == any(each["severity"] == "error" for each in found), result.output
    return found


def names(found: list[dict[str, Any]]) -> list[tuple[str, int]]:
    """Return the names and lines of diagnostics."""
    return [(each["name"], each["line"]) for each in found]


@contextmanager
def working_in(folder: Path) -> Iterator[None]:
    """Change the current folder for a while."""
    before = Path.cwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)
