"""Of states that differ only in which of interchangeable things is which, the built-in planner expands one."""

from __future__ import annotations

import dataclasses

import pytest
from msgspec.structs import replace

from plans.depot import goal, library, world
from skillc_model.pddl.formulas import Atom
from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.plan import Solved
from skillc_runtime.planning.problem.pose import pose_problem
from skillc_runtime.planning.search import astar
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.search.grounding import Grounding
from skillc_runtime.planning.search.states import SearchTask, make_task
from skillc_runtime.planning.search.symmetry import Symmetry, find_symmetry


def pose(crates: dict[str, str], wanted: str, robots: str = "one") -> Problem:
    state = world(dict.fromkeys(robots.split(), "a"), crates)
    return pose_problem(library(), state, goal(wanted, state)).problem


def carried(names: str, to: str = "b") -> str:
    return " and ".join(f"lab:{to} contain lab:{each}" for each in names.split())


def read(problem: Problem) -> tuple[SearchTask, Symmetry | None, dict[str, int]]:
    """Return the task, its symmetry, and states in which each crate alone is somewhere else, by crate."""
    task = make_task(Grounding(problem))
    assert task is not None
    moved = {}
    for name in problem.names:
        there = [number for atom, number in task.numbers.items() if name in atom.terms and "b" in atom.terms]
        moved[name] = sum(1 << number for number in there)
    return task, find_symmetry(problem, task.numbers), moved


def test_states_that_differ_in_what_is_interchangeable_are_one() -> None:
    _, symmetry, moved = read(pose({"c1": "a", "c2": "a", "c3": "c"}, carried("c1 c2 c3")))
    assert symmetry is not None
    assert len({symmetry.canonical(moved[each]) for each in ("c1", "c2", "c3")}) == 1
    both = symmetry.canonical(moved["c1"] | moved["c2"])
    assert both == symmetry.canonical(moved["c2"] | moved["c3"]) != symmetry.canonical(moved["c1"])


@pytest.mark.parametrize("of_other", ["not lab:b contain lab:c2", "lab:c contain lab:c2"])
def test_what_the_goal_tells_apart_is_not_interchangeable(of_other: str) -> None:
    _, symmetry, moved = read(pose({"c1": "a", "c2": "a"}, f"{carried('c1')} and {of_other}"))
    assert symmetry is None or symmetry.canonical(moved["c1"]) != symmetry.canonical(moved["c2"])


@pytest.mark.parametrize("case", ["what never changes", "a skill"])
def test_what_is_told_apart_elsewhere_is_not_interchangeable(case: str) -> None:
    problem = pose({"c1": "a", "c2": "a"}, carried("c1 c2"))
    task, symmetry, moved = read(problem)
    assert symmetry is not None and symmetry.canonical(moved["c1"]) == symmetry.canonical(moved["c2"])
    if case == "a skill":
        first, *rest = problem.domain.actions
        named = replace(first, precondition=Atom("at", ("c1", "a")))
        problem = replace(problem, domain=dataclasses.replace(problem.domain, actions=(named, *rest)))
    else:
        problem = replace(problem, init=(*problem.init, Atom("heavy", ("c2",))))
    places = find_symmetry(problem, task.numbers)
    assert places is not None, "all places but that of the goal"
    assert places.canonical(moved["c1"]) != places.canonical(moved["c2"])


def test_many_things_that_are_alike_are_planned_for(monkeypatch: pytest.MonkeyPatch) -> None:
    alike = [f"k{number}" for number in range(8)]
    many = AStar().plan(pose(dict.fromkeys(alike, "a"), carried(" ".join(alike))), CancelToken(60.0))
    assert isinstance(many, Solved) and (many.optimal, many.plan.duration_s) == ("proven", 107.0)
    few = pose(dict.fromkeys(("c1", "c2", "c3"), "a"), carried("c1 c2 c3"), "one two")
    one = AStar().plan(few, CancelToken(60.0))
    monkeypatch.setattr(astar, "find_symmetry", lambda problem, numbers: None)
    other = AStar().plan(few, CancelToken(60.0))
    assert isinstance(one, Solved) and isinstance(other, Solved) and one.optimal == other.optimal == "proven"
    assert one.plan.duration_s == other.plan.duration_s
