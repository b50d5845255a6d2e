"""A run without a report imports nothing that draws figures, pages or films: that takes longer than most runs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from commands.test_output import lab

__all__ = ["lab"]

DRAWING = {"skillc.services.run_report", "matplotlib", "PIL"}


@pytest.mark.slow
def test_what_draws_is_imported_for_a_report_only(lab: Path) -> None:
    assert imported_by_run(lab) & DRAWING == set()
    assert imported_by_run(lab, "--out", str(lab / "out")) >= DRAWING


def imported_by_run(lab: Path, *more: str) -> set[str]:
    """Run a goal in a process of its own, and return the names of the modules that it imports."""
    asked = ("run", "--library", str(lab), "--scene", str(lab / "scene.ttl"), "--goal", "lab:b contain lab:crate")
    command = (sys.executable, "-X", "importtime", "-m", "skillc", *asked, *more)
    ran = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert ran.returncode == 0, ran.stderr[-2000:]
    times = [line.rpartition("|") for line in ran.stderr.splitlines() if line.startswith("import time:")]
    return {name.strip() for _, _, name in times}
