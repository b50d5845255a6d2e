"""Planners report how far they are, and claim no more than they know."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from msgspec.structs import replace

from planners.test_makespan import BOTH, COMMAND, LIBRARY, WORLD
from planning.samples import CLEANED, LAB
from planning.test_large import CROWD, SMALL
from planning.test_solve import WIPING
from skillc_runtime.planning import progress
from skillc_runtime.planning.makespan.minimise import minimise_makespan
from skillc_runtime.planning.plan import Planner, Solved
from skillc_runtime.planning.planners import find_planners, list_planners
from skillc_runtime.planning.progress import PlanningProgress, describe_progress
from skillc_runtime.planning.schedule import Scheduled
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve


@pytest.fixture(autouse=True)
def reports_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress, "REPORT_S", 0.0)


@pytest.mark.parametrize("planner", [AStar(), *list_planners()[:-1]], ids=lambda each: each.name)
def test_reports_are_true_of_the_plan_that_is_found(planner: Planner) -> None:
    reports = list[PlanningProgress]()
    found = solve(WIPING, LAB, CLEANED, (planner,), report=reports.append)
    assert isinstance(found, Solved) and found.optimal == "proven"
    assert {each.planner for each in reports} == {planner.name} and len(reports) > 1
    assert max(each.states for each in reports) > 0
    assert all(each.individuals > 3 and not each.narrowed for each in reports[1:])
    assert_true(reports, found.plan.duration_s)
    bounds = [each.at_least_s for each in reports]
    assert bounds == sorted(bounds) and bounds[-1] > 0.0, "what is proved stays so"


def test_a_part_of_a_scene_is_called_so() -> None:
    reports = list[PlanningProgress]()
    solve(WIPING, CROWD, CLEANED, (AStar(),), size=SMALL, report=reports.append)
    assert any(each.narrowed for each in reports)
    assert all("part of the scene" in describe_progress(each) for each in reports if each.narrowed and each.individuals)


@pytest.mark.slow
def test_a_scheduler_reports_the_makespan_that_it_has_found() -> None:
    reports = list[PlanningProgress]()
    if COMMAND is None:
        pytest.skip("CP-SAT is not installed")
    found = minimise_makespan(LIBRARY, WORLD, BOTH, find_planners(), report=reports.append)
    assert isinstance(found, Scheduled)
    assert_true([each for each in reports if each.planner == "CP-SAT"], found.schedule.makespan_s)


def assert_true(reports: Sequence[PlanningProgress], least_s: float) -> None:
    for each in reports:
        assert each.best_s is None or each.best_s >= least_s - 1e-6
        assert each.at_least_s <= least_s + 1e-6


def test_progress_in_one_line() -> None:
    begun = PlanningProgress(planner="Fast Downward", individuals=12, narrowed=True)
    assert describe_progress(begun) == "Fast Downward: part of the scene, 12 individuals, no plan yet"
    later = PlanningProgress(planner="Fast Downward", individuals=40, best_s=30.0, at_least_s=24.5, states=1200)
    said = "Fast Downward: 40 individuals, 1200 states, a plan of 30 s, any takes at least 24.5 s"
    assert describe_progress(later) == said
    costs = replace(later, costs=True)
    assert describe_progress(costs).endswith("1200 states, a plan of cost 30, any costs 24.5 or more")
