"""Whoever follows the session of the pages on serving cells, in a shell or with its programs, gets what it shows."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from docs.pages import ROOT, blocks
from docs.server_session import follow_session, read_session

PROGRAMS = ROOT / "docs/server-programs.md"


@pytest.mark.early
@pytest.mark.sim
def test_the_session_goes_as_it_says(tmp_path: Path) -> None:
    session = read_session(tmp_path)
    assert sum(each.language == "text" for each in session) == 6
    follow_session(session, tmp_path)


@pytest.mark.early
@pytest.mark.sim
@pytest.mark.parametrize(("file", "program"), [("session.py", "python"), ("session.sh", "curl")])
def test_programs_go_through_the_same_session(file: str, program: str, tmp_path: Path) -> None:
    if shutil.which(program) is None:
        pytest.skip(f"there is no {program} here, with which {file} works")
    page = tuple(blocks(PROGRAMS))
    (start,) = (number for number, each in enumerate(page) if each.words == file)
    written, typed, shown = page[start : start + 3]
    assert (typed.language, shown.language) == ("sh", "text")
    project = read_session(tmp_path)[:2]
    assert [each.language for each in project] == ["sh", "skill"]
    follow_session((*project, written, typed, shown), tmp_path)
