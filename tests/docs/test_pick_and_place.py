"""The page on pick and place, done as it says in an empty folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.pages import ROOT, Reader, blocks

PAGE = ROOT / "docs/pick-and-place.md"


def follow(folder: Path, monkeypatch: pytest.MonkeyPatch, everything: bool) -> Reader:
    (folder / "bench").mkdir()
    monkeypatch.chdir(folder / "bench")
    reader = Reader(monkeypatch, everything)
    reader.follow(PAGE)
    return reader


@pytest.mark.slow
def test_what_is_checked_and_planned_is_as_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert follow(tmp_path, monkeypatch, everything=False).done >= 15


@pytest.mark.sim
def test_everything_is_as_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    typed = sum(block.text.count("\n") for block in blocks(PAGE) if block.language == "sh")
    assert follow(tmp_path, monkeypatch, everything=True).done == typed
    for name in ("path.svg", "grips.svg", "report.html", "result.json", "events.jsonl"):
        assert (tmp_path / "bench/out" / name).is_file()
