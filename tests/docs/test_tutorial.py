"""The tutorial, done as it says in an empty folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.pages import ROOT, Reader

TUTORIAL = ROOT / "docs/tutorial.md"


def follow(folder: Path, monkeypatch: pytest.MonkeyPatch, everything: bool) -> Reader:
    monkeypatch.chdir(folder)
    reader = Reader(monkeypatch, everything)
    reader.follow(TUTORIAL)
    return reader


@pytest.mark.slow
def test_everything_but_running_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert follow(tmp_path, monkeypatch, everything=False).done >= 10
    assert (tmp_path / "press_panel/out/reference/skill/Polish.html").is_file()


@pytest.mark.sim
def test_everything_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert follow(tmp_path, monkeypatch, everything=True).done >= 14
