"""The page about files and formats, done as it says."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

from docs.pages import ROOT, Reader, blocks

PAGE = ROOT / "docs/data.md"


def test_files_are_written_and_read_as_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    reader = Reader(monkeypatch, everything=False)
    reader.follow(PAGE)
    assert reader.done >= 2


@pytest.mark.sim
def test_signals_are_read_as_the_page_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Reader(monkeypatch, everything=True).follow(PAGE)
    (expected,) = (block.text for block in blocks(PAGE) if block.language == "printed")
    capsys.readouterr()
    runpy.run_path("force.py")
    assert capsys.readouterr().out == expected
