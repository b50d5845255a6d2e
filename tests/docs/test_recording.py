"""The page on recordings, done as it says in an empty folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.pages import ROOT, Reader

PAGE = ROOT / "docs/recording.md"


@pytest.mark.sim
def test_everything_is_as_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    reader = Reader(monkeypatch)
    reader.follow(PAGE)
    assert reader.done == 2
    assert (tmp_path / "pressed/recording.mcap").is_file()
