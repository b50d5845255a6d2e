"""The page about `skillc why`, done as it says."""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.pages import ROOT, Reader, blocks
from skillc_runtime.recording.events import ImplementationChosen, TaskStarted
from skillc_runtime.recording.reader import TraceReader
from skillc_runtime.world.state.labels.labelled import LabelledQuantity

PAGE = ROOT / "docs/why.md"


def test_the_lines_of_the_event_file_are_events(tmp_path: Path) -> None:
    (example,) = (block.text for block in blocks(PAGE) if block.language == "jsonl")
    (tmp_path / "events.jsonl").write_text(example, encoding="utf-8")
    started, chosen = TraceReader(tmp_path / "events.jsonl").events
    assert isinstance(started, TaskStarted)
    assert isinstance(chosen, ImplementationChosen) and chosen.bindings["force"] == LabelledQuantity(10.0, "N")


@pytest.mark.sim
def test_recordings_are_explained_as_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    reader = Reader(monkeypatch)
    reader.follow(PAGE)
    assert reader.done == sum(block.text.count("\n") for block in blocks(PAGE) if block.language == "sh") == 7
