"""The page about comparing and replaying runs, done as it says."""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.pages import ROOT, Reader, blocks

PAGE = ROOT / "docs/replay.md"


@pytest.mark.sim
def test_recordings_are_compared_as_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    reader = Reader(monkeypatch)
    reader.follow(PAGE)
    assert reader.done == sum(block.text.count("\n") for block in blocks(PAGE) if block.language == "sh") > 2
