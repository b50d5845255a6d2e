"""Commands import what they use: help, formatting and lists of tasks need neither arrays nor the simulator."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

HEAVY = {"numpy", "mujoco", "numba", "matplotlib", "rdflib", "pyoxigraph"}

PROGRAM = """
import sys
from skillc.cli.main import main
try:
    main(sys.argv[1:])
except SystemExit:
    print(*sys.modules, file=sys.stderr)
"""


@pytest.mark.slow
@pytest.mark.parametrize("command", [("--help",), ("run", "--help"), ("fmt", "--check", "."), ("tasks",)])
def test_what_needs_no_simulator_imports_none(command: tuple[str, ...], tmp_path: Path) -> None:
    (tmp_path / "own.skill").write_text("skill Wait() {}\n", encoding="utf-8")
    arguments = (sys.executable, "-c", PROGRAM, *command)
    run = subprocess.run(arguments, cwd=tmp_path, capture_output=True, text=True, check=True)
    modules = set(run.stderr.split())
    assert "skillc.cli.main" in modules
    assert modules & HEAVY == set()


@pytest.mark.slow
def test_a_run_imports_what_draws_for_its_report_at_most_in_another_process() -> None:
    program = "import skillc.services.run.report, sys; print(*sys.modules)"
    run = subprocess.run((sys.executable, "-c", program), capture_output=True, text=True, check=True)
    assert "numpy" in run.stdout and "matplotlib" not in run.stdout.split()
