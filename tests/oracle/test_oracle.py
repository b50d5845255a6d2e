"""Random libraries, compiled from text, held against trying every step in the world model and against unified-planning.

SKILLC_EXAMPLES says how many of each kind are tried.
"""

from __future__ import annotations

import os

import pytest
from msgspec.structs import replace

from oracle.drawing import CROWD, Dice
from oracle.forced import TooManyStates, cheapest
from oracle.text import Contradictory
from skillc_model.conditions import And, Condition
from skillc_model.pddl.preparing.complement import add_complements
from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.abstraction.lower_bound import relax_scene
from skillc_runtime.planning.plan import Planner, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.planners import list_planners
from skillc_runtime.planning.problem.neighbourhood import AbstractionSize
from skillc_runtime.planning.problem.pose import pose_problem
from skillc_runtime.planning.reachability import explain_unreachable
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.search.greedy import GreedySearch
from skillc_runtime.planning.solve import solve
from skillc_runtime.world.state.world_state import WorldState
from waiting import LONG_S

EXAMPLES = int(os.environ.get("SKILLC_EXAMPLES", "0"))


def drawn(dice: Dice) -> tuple[SkillLibrary, WorldState, Condition]:
    """Draw skills, a scene and a goal."""
    skills, state = dice.library(), dice.scene()
    try:
        return skills, state, dice.goal(skills, state)
    except Contradictory:
        pytest.skip("the compiler refuses the goal")


def least(skills: SkillLibrary, state: WorldState, goal: Condition) -> float:
    """Return the least cost of a plan, infinity where there is none; the test is skipped where there is too much."""
    try:
        cost = cheapest(skills, state, goal)
    except TooManyStates:
        pytest.skip("too many states for trying everything")
    return float("inf") if cost is None else cost


def cost_of(answer: PlanResult) -> float:
    """Return what a proven answer says that the cheapest plan costs."""
    match answer:
        case Solved(plan=plan, optimal="proven"):
            return plan.duration_s
        case Unsolvable():
            return float("inf")
        case _:
            raise AssertionError(f"nothing is proved: {answer}")


@pytest.mark.parametrize("seed", range(EXAMPLES or 8))
def test_the_built_in_planner_finds_the_cheapest_plan(seed: int) -> None:
    skills, state, goal = drawn(Dice(seed))
    assert cost_of(solve(skills, state, goal, (AStar(),), CancelToken(LONG_S))) == pytest.approx(
        least(skills, state, goal)
    )


@pytest.mark.parametrize("seed", range(EXAMPLES or 8))
def test_the_greedy_search_finds_a_plan_where_there_is_one(seed: int) -> None:
    skills, state, goal = drawn(Dice(seed))
    found = solve(skills, state, goal, (GreedySearch(),), CancelToken(LONG_S))
    assert isinstance(found, Solved if least(skills, state, goal) < float("inf") else Unsolvable)


@pytest.mark.parametrize("seed", range(EXAMPLES or 2))
@pytest.mark.parametrize("planner", list_planners()[:-1], ids=lambda planner: planner.name)
def test_every_other_planner_finds_a_plan_as_cheap(seed: int, planner: Planner) -> None:
    skills, state, goal = drawn(Dice(1000 + seed))
    own = solve(skills, state, goal, (AStar(),), CancelToken(LONG_S))
    assert cost_of(solve(skills, state, goal, (planner,), CancelToken(LONG_S))) == pytest.approx(cost_of(own))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(EXAMPLES or 2))
def test_pddl_means_what_the_world_model_means(seed: int) -> None:
    from emit.unified import disagreements, takes  # unified-planning takes seconds to import

    skills, state, goal = drawn(Dice(seed))
    problem = pose_problem(skills, state, And(()))
    if not problem.problem.domain.actions:
        pytest.skip("no skill of this domain can be planned with")
    wrong, tried = disagreements(problem, state)
    assert wrong == []
    assert tried
    answer = solve(skills, state, goal, (AStar(),), CancelToken(LONG_S))
    if isinstance(answer, Solved) and answer.plan.steps:
        assert takes(pose_problem(skills, state, goal), answer.plan)


@pytest.mark.parametrize("seed", range(EXAMPLES or 5))
def test_nothing_wrong_is_said_of_a_scene_from_a_part_of_it(seed: int) -> None:
    skills, state, goal = drawn(Dice(seed, CROWD))
    size = AbstractionSize(1 + seed % 3, 1)
    narrow = pose_problem(skills, state, goal, (), size)
    whole = AStar().plan(pose_problem(skills, state, goal).problem, CancelToken(LONG_S))
    bound = relax_scene(narrow, state)
    if bound is not None:
        assert cost_of(AStar().plan(bound, CancelToken(LONG_S))) <= cost_of(whole) + 1e-9
    first = solve(skills, state, goal, (AStar(),), CancelToken(LONG_S), size=size)
    if isinstance(first, Solved) and first.optimal != "proven":
        assert first.optimal == "optimal for the filtered problem"
        assert (first.at_least_s or 0.0) <= cost_of(whole) <= first.plan.duration_s
    else:
        assert cost_of(first) == pytest.approx(cost_of(whole))
    proven = solve(skills, state, goal, (AStar(),), CancelToken(LONG_S), size=replace(size, proves=True))
    assert cost_of(proven) == pytest.approx(cost_of(whole))
    assert explain_unreachable(skills, state, goal) is None or isinstance(whole, Unsolvable)


@pytest.mark.parametrize("seed", range(EXAMPLES or 5))
def test_saying_what_is_not_true_changes_nothing(seed: int) -> None:
    skills, state, goal = drawn(Dice(seed))
    problem = pose_problem(skills, state, goal).problem
    assert cost_of(AStar().plan(add_complements(problem), CancelToken(LONG_S))) == cost_of(
        AStar().plan(problem, CancelToken(LONG_S))
    )
