"""A run imports what it needs: what draws takes longer than most runs, and so does the compiler."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from commands.test_output import lab
from waiting import LONG_S

__all__ = ["lab"]

REPORT, DRAWING = "skillc.services.run.report", {"matplotlib"}
UNUSED = {"glfw", "rich", "skillc.services.run.dry_runs", "skillc_compiler.checks", "skillc_dsl.parsing.parser"}
TASK = """
task fill {
    scene "scene.ttl"
    goal lab:b contain lab:crate
}
"""


@pytest.mark.slow
def test_what_writes_reports_is_imported_for_one_only_and_another_process_draws(lab: Path) -> None:
    assert imported_by_run(lab) & {REPORT, *DRAWING} == set()
    with_report = imported_by_run(lab, "--out", str(lab / "out"))
    assert REPORT in with_report and with_report & DRAWING == set()


@pytest.mark.slow
def test_a_task_of_a_library_that_was_compiled_needs_no_compiler(lab: Path) -> None:
    written = (lab / "depot.skill").read_text("utf-8")
    (lab / "depot.skill").write_text(f"prefix lab: <http://example.org/lab#>\n{written}{TASK}", "utf-8")
    assert imported(f"{lab}:fill") >= {"skillc_compiler.checks", "skillc_dsl.parsing.parser"}
    assert imported(f"{lab}:fill") & UNUSED == set()


def imported_by_run(lab: Path, *more: str) -> set[str]:
    """Run a goal in a process of its own, and return the names of the modules that it imports."""
    return imported(
        "--library", str(lab), "--scene", str(lab / "scene.ttl"), "--goal", "lab:b contain lab:crate", *more
    )


def imported(*asked: str) -> set[str]:
    command = (sys.executable, "-X", "importtime", "-m", "skillc", "run", *asked)
    ran = subprocess.run(command, capture_output=True, text=True, timeout=LONG_S)
    assert ran.returncode == 0, ran.stderr[-2000:]
    times = [line.rpartition("|") for line in ran.stderr.splitlines() if line.startswith("import time:")]
    return {name.strip() for _, _, name in times}
