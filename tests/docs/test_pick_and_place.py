"""The page on pick and place, done as it says in an empty folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.pages import ROOT, Reader, blocks

PAGE = ROOT / "docs/pick-and-place.md"


def follow(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Reader:
    (folder / "bench").mkdir()
    monkeypatch.chdir(folder / "bench")
    reader = Reader(monkeypatch)
    reader.follow(PAGE)
    return reader


@pytest.mark.sim
def test_everything_is_as_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    typed = sum(block.text.count("\n") for block in blocks(PAGE) if block.language == "sh")
    assert follow(tmp_path, monkeypatch).done == typed
    for name in ("path.svg", "grips.svg", "report.html", "result.json", "events.jsonl"):
        assert (tmp_path / "bench/out" / name).is_file()
