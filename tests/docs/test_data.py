"""The page about files and formats, done as it says."""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.pages import ROOT, Reader

PAGE = ROOT / "docs/data.md"


def test_files_are_written_and_read_as_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    reader = Reader(monkeypatch, everything=False)
    reader.follow(PAGE)
    assert reader.done >= 2
