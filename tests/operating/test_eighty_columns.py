"""What commands show in a terminal with 80 columns: every word of a wide one, no line wider, indents kept."""

from __future__ import annotations

import os
import shlex
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from operating.terminal import Line, Terminal, text_of
from projects.folders import call

COLUMNS, WIDE = 80, 400
IRI = "http://example.org/a-laboratory-with-a-long-name/lab#"
QUESTION = "Is the crate on the shelf at the window, with its label to the front, and its lid closed as it should be?"
SKILLS = f"""use skiros
import "asking.skill"
prefix lab: <{IRI}>

skill Carry {{
    in    crate: Product
    in    to:    Location
    infer from:  Location
    pre   from contain crate
    pre   not to contain crate
    post moved: to contain crate
}}

impl at_once of Carry {{ do seq {{ wait 100 ms apply moved }} }}

task bring {{ goal lab:shelf-at-the-window contain lab:crate-with-a-name }}

task deliver {{
    do seq {{
        Carry(crate: lab:crate-with-a-name, to: lab:shelf-at-the-window)
        Carry(crate: lab:crate-with-a-name, to: lab:shelf-at-the-door)
    }}
}}

task asked {{
    do Ask(text: "{QUESTION}", choices: "yes, and all is well | no, it has been taken away", limit: 60 s)
}}
"""
SCENE = f"""@prefix lab: <{IRI}> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
lab:shelf-at-the-door a skiros:Location ; skiros:contain lab:crate-with-a-name .
lab:shelf-at-the-window a skiros:Location .
lab:crate-with-a-name a skiros:Product .
"""
TIMES = ("time ", "speed ", "checking ")
"""How lines begin that depend on the speed of the machine."""


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("depot")
    (folder / "skillc.toml").write_text('name = "depot"\nversion = "0.1.0"\nscene = "scene.ttl"\n', "utf-8")
    (folder / "depot.skill").write_text(SKILLS, "utf-8")
    (folder / "scene.ttl").write_text(SCENE, "utf-8")
    return folder


def start(command: str, folder: Path, columns: int) -> Terminal:
    """Start a command of skillc in a terminal."""
    return Terminal((sys.executable, "-m", "skillc", *shlex.split(command)), dict(os.environ), columns, folder)


def lines_of(command: str, folder: Path, columns: int) -> list[str]:
    """Return the lines that a command leaves in a terminal."""
    with start(command, folder, columns) as terminal:
        terminal.wait()
        lines: list[Line] = terminal.lines
    return [line for each in lines if not (line := text_of(each)).startswith(TIMES)]


def indent_of(line: str) -> int:
    """Return how many blanks a line begins with."""
    return len(line) - len(line.lstrip())


def find_faults(narrow: list[str], wide: list[str]) -> Iterator[str]:
    """Yield what is wrong in the lines of a narrow terminal, given those of a wide one."""
    yield from (f"too wide: {line}" for line in narrow if len(line) > COLUMNS)
    rest = iter(narrow)
    for whole in filter(None, map(str.rstrip, wide)):
        first, words = True, whole.split()
        while words:
            line = next(rest, None)
            if line is None or line.split() != words[: len(line.split())]:
                yield f"{line!r} is not how {' '.join(words)!r} begins"
                return
            if line and indent_of(line) < max(indent_of(whole), not first):
                yield f"no indent: {line}"
            first, words = first and not line, words[len(line.split()) :]
    yield from (f"not in the wide terminal: {line}" for line in rest if line.strip())


def printed(command: str, folder: Path, columns: int, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return the lines that a command prints for a page of so many columns, without a display that changes."""
    monkeypatch.setenv("COLUMNS", str(columns))
    shown = call(folder, *shlex.split(command))
    assert shown.exit_code == 0, shown.output
    return [line for line in shown.output.splitlines() if not line.startswith(TIMES)]


def test_each_word_is_shown_within_the_width(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    narrow, wide = (
        lines_of(f"run deliver --backend kinematic --out out-{columns}", project, columns)
        for columns in (COLUMNS, WIDE)
    )
    wide = [line.replace(f"out-{WIDE}", f"out-{COLUMNS}") for line in wide]
    assert any("no film" in line for line in wide) and list(find_faults(narrow, wide)) == [], "\n".join(narrow)
    run = f"out-{COLUMNS}"
    for command in (
        f"why {run}",
        f"why {run} 1",
        f"replay {run} --check",
        "plan bring",
        "tasks",
        "check",
        "world",
    ):
        narrow, wide = (printed(command, project, columns, monkeypatch) for columns in (COLUMNS, WIDE))
        assert wide and list(find_faults(narrow, wide)) == [], "\n".join((command, *narrow))
        assert not any(IRI in line for line in wide), "names are short"


def test_a_question_is_shown_whole(project: Path) -> None:
    with start("run asked --backend kinematic", project, COLUMNS) as terminal:
        terminal.expect(r"taken\s+away")
        lines = [text_of(each) for each in terminal.lines]
        first = next(number for number, line in enumerate(lines) if line.strip().startswith(QUESTION[:20]))
        assert QUESTION in " ".join(each.strip() for each in lines[first:])
        assert all(len(each) <= COLUMNS for each in lines)
        terminal.type("1")
        assert terminal.wait() == 0
        assert "yes, and all is well" in terminal.shown
