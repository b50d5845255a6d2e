"""Problems with numbers: what is made of them has no error, and is planned at the optimum of the original."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from heapq import heappop, heappush
from itertools import count, product
from pathlib import Path
from typing import Any

import pytest

from pddl_import.test_classic_problems import call, measured
from skillc.services.pddl_import.importing import import_pddl

PROBLEMS = sorted(Path(__file__).parent.glob("numeric/*/*-1.pddl"))
READ_BY_OTHERS = [each for each in PROBLEMS if each.stem not in ("colony-1", "ovens-1")]
"""Those that unified-planning reads and simulates: it reads no `scale-up`, and simulates nothing that takes time."""
MOST_COST = 40


def optimum(problem: Path) -> float:
    """Return what the first line of a file says."""
    found = re.match(r"; Optimum: (\d+)\n", problem.read_text("utf-8"))
    assert found
    return float(found[1])


@pytest.mark.slow
@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda each: each.stem)
def test_the_plan_costs_the_optimum(problem: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    imported = import_pddl(problem.parent / "domain.pddl", problem, tmp_path / "made")
    assert not imported.warnings
    monkeypatch.chdir(tmp_path / "made")
    assert "no problems" in call("check").output
    answer = json.loads(call("plan", "--json", "--no-plan-cache").stdout)
    assert (measured(answer), answer["plan_optimal"]) == (optimum(problem), True)


@pytest.mark.slow
@pytest.mark.parametrize("problem", READ_BY_OTHERS, ids=lambda each: each.stem)
def test_the_optimum_is_that_of_the_original(problem: Path) -> None:
    """Try everything in the simulator of unified-planning."""
    from emit.unified import PDDLReader, UPSequentialSimulator  # unified-planning takes seconds to import

    original = PDDLReader().parse_problem(str(problem.parent / "domain.pddl"), str(problem))
    simulator = UPSequentialSimulator(original, error_on_failed_checks=False)
    steps, tie, seen = list(_list_steps(original)), count(), set[object]()
    fluents = list(_list_fluents(original))
    ways = [(0, next(tie), simulator.get_initial_state())]
    while ways:
        cost, _, state = heappop(ways)
        key = tuple(str(state.get_value(each)) for each in fluents)
        if key in seen or cost > MOST_COST:
            continue
        seen.add(key)
        if simulator.is_goal(state):
            assert cost == optimum(problem)
            return
        for action, chosen in steps:
            if simulator.is_applicable(state, action, chosen):
                after = simulator.apply(state, action, chosen)
                heappush(ways, (cost + _cost(original, state, action, chosen, after), next(tie), after))
    raise AssertionError("there is no plan")


def _list_steps(problem: Any) -> Iterator[tuple[Any, tuple[Any, ...]]]:
    for action in problem.actions:
        for chosen in product(*(problem.objects(each.type) for each in action.parameters)):
            yield action, tuple(chosen)


def _list_fluents(problem: Any) -> Iterator[Any]:
    for fluent in problem.fluents:
        if fluent.name not in ("total-cost", "paint-used"):
            for chosen in product(*(problem.objects(each.type) for each in fluent.signature)):
                yield fluent(*chosen)


def _cost(problem: Any, state: Any, action: Any, chosen: Any, after: Any) -> int:
    """Return by how much a step changes what is minimised, 1 where nothing is."""
    minimised = [each for each in problem.fluents if each.name in ("total-cost", "paint-used")]
    if minimised:
        before, then = (each.get_value(minimised[0]()).constant_value() for each in (state, after))
        return int(then - before)
    for metric in problem.quality_metrics:
        costs = getattr(metric, "costs", {})
        if action in costs:
            values = dict(zip(action.parameters, chosen, strict=True))
            amount = costs[action].substitute(
                {problem.environment.expression_manager.ParameterExp(p): v for p, v in values.items()}
            )
            return int(
                state.get_value(amount).constant_value() if not amount.is_constant() else amount.constant_value()
            )
    return 1
