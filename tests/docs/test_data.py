"""The page about files and formats, done as it says."""

from __future__ import annotations

import runpy
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from docs.pages import ROOT, Reader, blocks

PAGE = ROOT / "docs/data.md"


@pytest.mark.sim
def test_files_are_written_and_read_as_the_page_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Reader(monkeypatch).follow(PAGE)
    (expected,) = (block.text for block in blocks(PAGE) if block.language == "printed")
    capsys.readouterr()
    runpy.run_path("force.py")
    assert capsys.readouterr().out == expected
    check_signals(pd.read_parquet("run/signals.parquet"))


def check_signals(table: pd.DataFrame) -> None:
    """The rows are evenly in time, and the force that is sensed is that of the contacts."""
    truth = table["Eraser-1/truth/contact_force_n"]
    sensed = np.linalg.norm(table[[f"Ur5e-1/sensor/force_{axis}_n" for axis in "xyz"]], axis=1)
    wiping = truth > 3.0
    assert wiping.sum() > 500
    assert abs(sensed[wiping].mean() / truth[wiping].mean() - 1.0) < 0.25
    steps = np.diff(table["time_s"])
    assert steps.min() > 0.0 and np.allclose(steps, 0.01, atol=1e-6)
