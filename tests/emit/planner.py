"""Runs Fast Downward's translator and search in a folder of its own."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

from skillc_model.pddl.problem import Problem
from skillc_model.pddl.text import format_domain, format_problem
from waiting import LONG_S


def search_binary() -> Path | None:
    """Return Fast Downward's search component, None where the package is not installed."""
    found = find_spec("up_fast_downward")
    if found is None or found.origin is None:
        return None
    binary = Path(found.origin).parent / "downward/builds/release/bin/downward"
    return binary if binary.is_file() else None


def solve(problem: Problem, folder: Path) -> list[str]:
    """Return the optimal plan's steps as `name argument ..`; fails the test unless lmcut proves it, without axioms."""
    binary = search_binary()
    assert binary is not None
    (folder / "domain.pddl").write_text(format_domain(problem.domain))
    (folder / "problem.pddl").write_text(format_problem(problem))
    translate = [sys.executable, "-m", "fast_downward.translate", "--sas-file", "o.sas", "domain.pddl", "problem.pddl"]
    told = subprocess.run(translate, cwd=folder, capture_output=True, text=True, timeout=LONG_S, check=False)
    assert told.returncode == 0, told.stdout[-500:] + told.stderr[-500:]
    assert "Translator axioms: 0" in told.stdout
    search = [str(binary), "--internal-plan-file", "plan", "--search", "astar(lmcut())"]
    with (folder / "o.sas").open() as task:
        told = subprocess.run(
            search, cwd=folder, stdin=task, capture_output=True, text=True, timeout=LONG_S, check=False
        )
    assert told.returncode == 0, told.stdout[-500:]
    lines = (folder / "plan").read_text().splitlines()
    return [line.strip("() ") for line in lines if line.startswith("(")]
