"""The tutorial, done as it says in an empty folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.pages import ROOT, Reader

TUTORIAL = ROOT / "docs/tutorial.md"


def follow(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Reader:
    monkeypatch.chdir(folder)
    reader = Reader(monkeypatch)
    reader.follow(TUTORIAL)
    return reader


@pytest.mark.early
@pytest.mark.sim
def test_everything_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert follow(tmp_path, monkeypatch).done >= 14
    assert (tmp_path / "press_panel/out/reference/skill/Polish.html").is_file()
