"""Classic problems: what is made of them has no error, is planned at the known optimum, and runs without bodies."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from docs.pages import ROOT
from skillc.cli.main import skillc

PROBLEMS = sorted((ROOT / "benchmarks/classic_problems").glob("*/*-*.pddl"))
SOME = ("depot-1", "hanoi-1", "miconic-1", "sokoban-1", "transport-1")
"""Those that are planned here; `benchmarks/classic.py` compares all with Fast Downward."""


def call(*words: str) -> Any:
    result = CliRunner().invoke(skillc, words)
    assert result.exit_code == 0, result.output
    return result


def measured(answer: Any) -> float:
    """Return of a plan in JSON what its task minimises: the cost, else the work."""
    return float(answer["cost"] if answer["minimise"] == "cost" else answer["duration_s"])


def test_there_are_seventeen_of_ten_domains_with_their_optima() -> None:
    assert (len(PROBLEMS), len({each.parent for each in PROBLEMS})) == (17, 10)
    assert all(re.match(r"; Optimum: \d+\n", each.read_text("utf-8")) for each in PROBLEMS)


@pytest.mark.slow
@pytest.mark.parametrize("name", SOME)
def test_the_plan_costs_the_optimum(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    problem = next(each for each in PROBLEMS if each.stem == name)
    made = call("import", "pddl", str(problem.parent / "domain.pddl"), str(problem), "--out", str(tmp_path / "made"))
    assert "warning" not in made.output
    monkeypatch.chdir(tmp_path / "made")
    assert "no problems" in call("check").output
    assert call("fmt", "--check").exit_code == 0
    answer = json.loads(call("plan", "--json", "--no-plan-cache").stdout)
    assert answer["plan_optimal"]
    optimum = problem.read_text("utf-8").splitlines()[0].removeprefix("; Optimum: ")
    assert measured(answer) == float(optimum)
    if name == "transport-1":
        assert "finished" in call("run").output
