"""Both domains with problems from the shipped scenes, as unified-planning reads, simulates and validates them."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from types import ModuleType

import pytest
from msgspec import structs

from skillc.services.reporting.reporter import SilentReporter
from skillc.services.tasks.loading import LoadedTask, load_task
from skillc_runtime.execution.assignment import AchieveGoal
from skillc_runtime.planning.plan import Plan, Solved
from skillc_runtime.planning.problem.chains import UnrolledProblem, unroll_chains
from skillc_runtime.planning.problem.pose import PosedProblem
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.recording.run_spec import RunSpec

pytestmark = pytest.mark.reasoner

TASKS = ("clean_whiteboard", "clean_table")


@pytest.fixture(scope="module")
def unified() -> ModuleType:
    """What asks unified-planning, which takes seconds to import: only these tests do."""
    return import_module("emit.unified")


@cache
def loaded(task: str) -> LoadedTask:
    """Return a task without the ways of wiping whose durations make actions of their own: each skill is one action."""
    with load_task(RunSpec(task=task), SilentReporter()) as found:
        wipe = found.library.skills["Wipe"]
        ways = tuple(each for each in wipe.implementations if each not in ("wipe_spots", "wipe_dirt"))
        skills = {**found.library.skills, "Wipe": structs.replace(wipe, implementations=ways)}
        return structs.replace(found, library=structs.replace(found.library, skills=skills))


@cache
def unrolled(task: str) -> UnrolledProblem:
    aim = loaded(task).assignment.objective
    assert isinstance(aim, AchieveGoal)
    return unroll_chains(loaded(task).library, loaded(task).assignment.state, aim.goal)


@cache
def posed(task: str) -> PosedProblem:
    return unrolled(task).pose()


@cache
def plan(task: str) -> Plan:
    assignment = loaded(task).assignment
    assert isinstance(assignment.objective, AchieveGoal)
    solved = solve(loaded(task).library, assignment.state, assignment.objective.goal, (AStar(),))
    assert isinstance(solved, Solved)
    return solved.plan


@pytest.mark.parametrize("task", TASKS)
def test_both_domains_are_read_whole(unified: ModuleType, task: str) -> None:
    problem = posed(task).problem
    actions = {each.name for each in problem.domain.actions}
    for read in (unified.classical(problem), unified.temporal(problem)):
        assert {each.name for each in read.actions} == actions
        assert {each.name for each in read.all_objects} == {each.name for each in problem.objects}
        assert len(read.goals) == 1


@pytest.mark.parametrize("task", TASKS)
def test_the_plan_is_one_for_both_domains(unified: ModuleType, task: str) -> None:
    assert unified.takes(posed(task), plan(task))
    assert unified.takes_in_time(posed(task), plan(task))


@pytest.mark.parametrize("task", TASKS)
def test_a_plan_without_one_of_its_steps_is_none(unified: ModuleType, task: str) -> None:
    steps = plan(task).steps
    assert steps
    for number in range(len(steps)):
        shorter = Plan((*steps[:number], *steps[number + 1 :]), 0.0)
        assert not unified.takes(posed(task), shorter)
        assert not unified.takes_in_time(posed(task), shorter)


@pytest.mark.parametrize("task", TASKS)
def test_every_step_has_the_effects_that_it_has_in_the_world(unified: ModuleType, task: str) -> None:
    wrong, tried = unified.disagreements(posed(task), unrolled(task).state)
    assert wrong == []
    assert tried
