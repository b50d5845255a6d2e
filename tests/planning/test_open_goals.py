"""Goals about whoever stands in a relation: steps may bring others there than those that stand in it at first."""

from __future__ import annotations

import pytest

from planning.samples import DRIVE, LAB, PICK, library, post, skill
from skillc_compiler.library.conditions import And, Anything, Condition, Holds, Individual, Not, Variable
from skillc_runtime.planning.choose import available
from skillc_runtime.planning.narrowing import Breadth
from skillc_runtime.planning.plan import Planner, Solved
from skillc_runtime.planning.solve import solve
from world.lab import iri, parameter

AT, CONTAIN, ROBOT, GRIPPER = iri("at"), iri("contain"), Individual(iri("robot")), Individual(iri("gripper"))
LIFT = skill("Lift", (parameter("robot", "Robot"),), (), (post(Not(Holds(Variable("robot"), AT, Anything()))),), 2.5)
FULL = Holds(GRIPPER, CONTAIN, Anything())
GOALS: list[tuple[Condition, list[str]]] = [
    (And((FULL, Not(Holds(ROBOT, AT, Anything())))), ["Drive", "Pick", "Lift"]),
    (And((FULL, Holds(ROBOT, AT, Anything()))), ["Drive", "Pick"]),
    (FULL, ["Drive", "Pick"]),
    (Not(Holds(Anything(), AT, Individual(iri("dock")))), ["Lift"]),
    (Holds(Anything(), AT, Individual(iri("wall"))), ["Drive"]),
]


@pytest.mark.parametrize("planner", available(), ids=lambda planner: planner.name)
@pytest.mark.parametrize(("goal", "expected"), GOALS)
def test_an_open_goal_counts_everybody(goal: Condition, expected: list[str], planner: Planner) -> None:
    answer = solve(library(DRIVE, PICK, LIFT), LAB, goal, (planner,))
    assert isinstance(answer, Solved) and answer.optimal == "proven", answer
    assert [each.skill for each in answer.plan.steps] == expected


def test_of_a_part_of_the_scene_nothing_is_claimed_about_who_was_left_out() -> None:
    goal = And((FULL, Not(Holds(ROBOT, AT, Anything()))))
    narrow = solve(library(DRIVE, PICK, LIFT), LAB, goal, breadth=Breadth(1, 1))
    assert isinstance(narrow, Solved) and narrow.plan.duration_s == 29.5
    whole = solve(library(DRIVE, PICK, LIFT), LAB, goal, breadth=Breadth(1, 1), prove=True)
    assert isinstance(whole, Solved) and whole.optimal == "proven"
