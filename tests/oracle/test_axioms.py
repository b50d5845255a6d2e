"""Random vocabularies with axioms and skills that name individuals, held against trying every step in the world model.

SKILLC_EXAMPLES says how many are tried.
"""

from __future__ import annotations

import os

import pytest

from oracle.agreement import disagreements
from oracle.forced import TooManyStates, cheapest, steps, worked
from oracle.vocabularies import Author
from oracle.well_typed import mistakes
from skillc_model.conditions import And
from skillc_model.pddl.formulas import FALSE
from skillc_model.pddl.planning import make_planning_domain
from skillc_model.pddl.pruning import prune_unread_values
from skillc_model.pddl.text import format_domain, format_problem, format_temporal_domain, format_temporal_problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.planners import list_planners
from skillc_runtime.planning.problem.pose import GoalError, pose_problem
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from waiting import LONG_S

EXAMPLES = int(os.environ.get("SKILLC_EXAMPLES", "0"))


def check_claim(answer: PlanResult, least: float, restricted: bool) -> None:
    """Check what an answer claims against the least cost of a plan, which is infinite where there is none."""
    match answer:
        case Solved(plan=plan, optimal="proven"):
            assert plan.duration_s == pytest.approx(least)
        case Solved(plan=plan, optimal="optimal for the filtered problem"):
            assert restricted and plan.duration_s >= least - 1e-9 and answer.at_least_s is None
        case Unsolvable():
            assert not restricted and least == float("inf")
        case GaveUp():
            assert restricted, answer
        case _:
            raise AssertionError(answer)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(EXAMPLES or 25))
def test_what_is_said_of_a_plan_is_true(seed: int) -> None:
    drawn = Author(seed).drawn()
    try:
        restricted = bool(pose_problem(drawn.library, drawn.state, drawn.goal).restricted)
        least = cheapest(drawn.library, drawn.state, drawn.goal)
    except (GoalError, TooManyStates):
        pytest.skip("the goal cannot be planned for, or there are too many states")
    answer = solve(drawn.library, drawn.state, drawn.goal, (AStar(),), CancelToken(LONG_S))
    check_claim(answer, float("inf") if least is None else least, restricted)


@pytest.mark.parametrize("seed", range(1000, 1000 + (EXAMPLES or 2)))
def test_the_strongest_planner_claims_the_same(seed: int) -> None:
    drawn = Author(seed).drawn()
    own = solve(drawn.library, drawn.state, drawn.goal, (AStar(),), CancelToken(LONG_S))
    other = solve(drawn.library, drawn.state, drawn.goal, list_planners()[:1], CancelToken(LONG_S))
    assert type(own) is type(other)
    if isinstance(own, Solved) and isinstance(other, Solved):
        assert (other.optimal, other.plan.duration_s) == (own.optimal, pytest.approx(own.plan.duration_s))


@pytest.mark.parametrize("seed", range(2000, 2000 + (EXAMPLES or 30)))
def test_a_step_works_for_the_planner_where_it_works_in_the_world(seed: int) -> None:
    drawn = Author(seed).drawn()
    assert list(disagreements(drawn.library, drawn.state)) == []
    after = (worked(step, drawn.library, drawn.state) for step in steps(drawn.library, drawn.state))
    later = next((each for each in after if each is not None), None)
    if later is not None:
        assert list(disagreements(drawn.library, later)) == []


@pytest.mark.parametrize("seed", range(3000, 3000 + (EXAMPLES or 20)))
def test_all_that_is_printed_is_well_typed(seed: int) -> None:
    drawn = Author(seed).drawn()
    alone = prune_unread_values(make_planning_domain(drawn.library))
    assert mistakes(format_domain(alone)) + mistakes(format_temporal_domain(alone)) == []
    for goal in (And(()), drawn.goal):
        try:
            problem = pose_problem(drawn.library, drawn.state, goal).problem
        except GoalError:
            continue
        if problem.goal != FALSE:
            assert mistakes(format_domain(problem.domain), format_problem(problem)) == []
            assert mistakes(format_temporal_domain(problem.domain), format_temporal_problem(problem)) == []


def test_the_type_checker_finds_mistakes() -> None:
    domain = """(define (domain d) (:types thing - object place box - thing)
      (:constants home - place) (:predicates (at ?b - box ?p - place))
      (:action go :parameters (?b - box) :precondition (not (at home ?b)) :effect (and (in ?b) (at ?c home))))"""
    assert mistakes(domain) == [
        "go: (at home ?b): home is a place, no box",
        "go: (at home ?b): ?b is a box, no place",
        "go: in is undeclared with 1 arguments",
        "go: ?c is undeclared",
    ]
    problem = "(define (problem p) (:domain d) (:objects home - place b - box) (:init (at b home)) (:goal (at b b)))"
    found = mistakes(domain, problem)
    assert "home is declared twice" in found and "(at b b): b is a box, no place" in found
