"""A step that does not go where a thing is may go where another step has put it, and the other way round."""

from __future__ import annotations

import pytest

from plans.depot import goal, iri, library, world
from skillc_model.conditions import And
from skillc_runtime.planning.plan import GaveUp, Planner, PlanResult, Solved, Step, StepWhile
from skillc_runtime.planning.planners import list_planners
from skillc_runtime.planning.solve import solve

WORLD = world({"carl": "a", "dora": "a"}, {"crate": "a"}, "a b")
WANTED = goal("lab:dora contain lab:crate", WORLD)
LOAD = Step("Load", {"robot": iri("dora"), "crate": iri("crate"), "from": iri("a")})
FOR_GOOD = [Step("Load", {**LOAD.arguments, "from": iri("b")})]


def called(answer: PlanResult) -> list[str]:
    assert isinstance(answer, Solved), answer
    return [f"{each.skill} {each.arguments['robot'].rpartition('#')[2]}" for each in answer.plan.steps]


@pytest.mark.parametrize("planner", list_planners(), ids=lambda planner: planner.name)
def test_what_one_does_not_reach_another_one_hands_over_at_the_same_place(planner: Planner) -> None:
    waiting = StepWhile(LOAD, And(()), "out of reach", unmoved=(iri("crate"),))
    answer = solve(library(), WORLD, WANTED, (planner,), without=[waiting, *FOR_GOOD])
    assert called(answer) == ["Load carl", "Unload carl", "Load dora"]
    assert isinstance(answer, Solved) and answer.optimal == "optimal for the filtered problem"


@pytest.mark.parametrize("planner", list_planners(), ids=lambda planner: planner.name)
def test_what_goes_only_where_a_thing_was_at_first_is_done_at_once(planner: Planner) -> None:
    gone = StepWhile(LOAD, And(()), "it is too far then", moved=(iri("crate"),))
    assert called(solve(library(), WORLD, WANTED, (planner,), without=[gone, *FOR_GOOD])) == ["Load dora"]
    never = [gone, StepWhile(LOAD, And(()), "out of reach", unmoved=(iri("crate"),)), *FOR_GOOD]
    assert isinstance(solve(library(), WORLD, WANTED, (planner,), without=never), GaveUp)
