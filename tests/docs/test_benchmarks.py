"""The benchmarks can be started: what they import exists."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from waiting import LONG_S

FOLDER = Path(__file__).parents[2] / "benchmarks"
BENCHMARKS = sorted(path.stem for path in FOLDER.glob("*.py"))


@pytest.mark.slow
def test_each_benchmark_can_be_imported() -> None:
    program = "import importlib, sys\nfor name in sys.argv[1:]: importlib.import_module(name)"
    folders = os.pathsep.join((str(FOLDER), str(FOLDER.parent / "tests")))
    imported = subprocess.run(
        (sys.executable, "-c", program, *BENCHMARKS),
        env={**os.environ, "PYTHONPATH": folders},
        capture_output=True,
        text=True,
        timeout=LONG_S,
        check=False,
    )
    assert imported.returncode == 0 and len(BENCHMARKS) > 10, imported.stderr
