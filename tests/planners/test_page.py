"""The page about planning, done as it says."""

from __future__ import annotations

from pathlib import Path

import pytest

from docs.pages import ROOT, Reader
from skillc_runtime.planning.fast_downward.solver import find_fast_downward


@pytest.mark.slow
@pytest.mark.skipif(find_fast_downward() is None, reason="the page speaks of planners that are extras")
def test_the_page_is_true(tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    reader = Reader(monkeypatch)
    reader.follow(ROOT / "docs/planning.md")
    assert reader.done == 2
    assert list((own_cache / "plans").iterdir())
