"""Each how-to can be followed in an empty folder: files are written and changed, commands typed, outputs compared."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from docs.pages import ROOT, Reader

PAGES = sorted({*(ROOT / "docs/how-to").glob("*.md")} - {ROOT / "docs/how-to/many-machines.md"})
"""All but the one about many machines: `trials/test_cluster.py` has a scheduler and workers."""

LEAST = 3
"""Commands that every page has, besides one."""


def test_there_are_how_tos() -> None:
    assert len(PAGES) >= 9


def follow(page: Path, folder: Path, monkeypatch: pytest.MonkeyPatch) -> Reader:
    monkeypatch.chdir(folder)
    monkeypatch.setenv("COLUMNS", "500")
    shutil.copy(ROOT / "tests/robot_import/lifter.urdf", folder)
    reader = Reader(monkeypatch)
    reader.follow(page)
    return reader


@pytest.mark.early
@pytest.mark.sim
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_everything_is_as_the_page_says(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert follow(page, tmp_path, monkeypatch).done > LEAST
