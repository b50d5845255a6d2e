"""Whoever follows the page on robots from URDF has an arm that a scene can use; the run is a task in simulation."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from docs.pages import ROOT, Reader
from skillc.cli.commands.add import command
from skillc.cli.settings import GroupedOption

PAGE = ROOT / "docs/add-robot.md"


def follow(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Reader:
    monkeypatch.setenv("COLUMNS", "500")
    monkeypatch.chdir(folder)
    shutil.copy(ROOT / "tests/robot_import/gen3.urdf", folder)
    reader = Reader(monkeypatch)
    reader.follow(PAGE)
    return reader


@pytest.mark.sim
@pytest.mark.usefixtures("own_cache")
def test_the_page_adds_an_arm_that_wipes_the_board(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert follow(tmp_path, monkeypatch).done == 8


def test_every_option_is_on_the_page() -> None:
    text = PAGE.read_text("utf-8")
    own = (each for each in command.params if isinstance(each, GroupedOption) and each.group == "Model file")
    options = {option for each in own for option in each.opts if option.startswith("--")}
    assert len(options) > 7
    assert {option for option in options if not re.search(rf"`[^`]*{option}\b", text)} == set()
