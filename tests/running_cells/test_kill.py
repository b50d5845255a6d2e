"""A cell whose process dies at any moment loses no fact, makes none twice, and its history can be read."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from random import Random

from running_cells.checking import check_cell
from running_cells.yard import CRATES, find_settings, write_yard
from waiting import LONG_S

KILLS = int(os.environ.get("SKILLC_CELL_KILLS", "2"))
"""How often the process of a cell is killed."""


def start_carrier(folder: Path, operation: str, *limit: str) -> subprocess.Popen[str]:
    """Start the process of a cell; return it once the operation was submitted."""
    command = (sys.executable, "-m", "running_cells.carrier", str(folder), operation, *limit)
    paths = os.pathsep.join([str(Path(__file__).parents[1]), *filter(None, sys.path)])
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": paths})
    assert process.stdout is not None
    assert process.stdout.readline() == "started\n"
    return process


def test_a_killed_cell_loses_nothing_and_repeats_nothing(tmp_path: Path) -> None:
    chance, killed = Random(0), 0
    write_yard(tmp_path, takes_ms=40)
    for life in range(10 * KILLS):
        with start_carrier(tmp_path, f"op-{life}") as process:
            try:
                process.wait(chance.uniform(0.2, 0.8) if killed < KILLS else LONG_S)
            except subprocess.TimeoutExpired:
                process.kill()
                killed += 1
        if process.returncode == 0:
            break
        check_cell(find_settings(tmp_path))
    assert killed > 0 and process.returncode == 0
    assert check_cell(find_settings(tmp_path))["lab:Goal"] == CRATES


def test_a_cell_whose_disk_is_full_stops_and_says_so(tmp_path: Path) -> None:
    write_yard(tmp_path, takes_ms=20)
    with start_carrier(tmp_path, "full", "120000") as process:
        assert process.stdout is not None
        said = process.stdout.read()
    assert "failed" in said and "journal.sqlite cannot be written (" in said
    brought = check_cell(find_settings(tmp_path))["lab:Goal"]
    assert brought < CRATES
    with start_carrier(tmp_path, "again") as process:
        process.wait(LONG_S)
    assert check_cell(find_settings(tmp_path))["lab:Goal"] == CRATES
