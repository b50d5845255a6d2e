"""Goals about whoever stands in a relation: steps may bring others there than those that stand in it at first."""

from __future__ import annotations

import msgspec
import pytest

from oracle.drawing import VOCABULARY
from oracle.text import compiled
from planning.samples import DRIVE, LAB, PICK, library, post, skill
from skillc_model.conditions import And, Anything, Condition, Holds, Individual, Not, Variable
from skillc_rdf.vocabulary.types import RelationTerm, Signature
from skillc_runtime.planning.plan import Planner, Solved
from skillc_runtime.planning.planners import list_planners
from skillc_runtime.planning.problem.neighbourhood import AbstractionSize
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.world.state.changes import AddIndividual
from skillc_runtime.world.state.world_state import WorldState
from world.lab import iri, parameter

AT, CONTAIN, ROBOT, GRIPPER = iri("at"), iri("contain"), Individual(iri("robot")), Individual(iri("gripper"))
LIFT = skill("Lift", (parameter("robot", "Robot"),), (), (post(Not(Holds(Variable("robot"), AT, Anything()))),), 2.5)
KEEP = """use t
skill Keep { in x: Tool\n in y: Place\n post x kept y\n duration 1 s }
impl hand of Keep { run python "nobody:Needs" }
"""
FULL = Holds(GRIPPER, CONTAIN, Anything())
GOALS: list[tuple[Condition, list[str]]] = [
    (And((FULL, Not(Holds(ROBOT, AT, Anything())))), ["Drive", "Pick", "Lift"]),
    (And((FULL, Holds(ROBOT, AT, Anything()))), ["Drive", "Pick"]),
    (FULL, ["Drive", "Pick"]),
    (Not(Holds(Anything(), AT, Individual(iri("dock")))), ["Lift"]),
    (Holds(Anything(), AT, Individual(iri("wall"))), ["Drive"]),
]


@pytest.mark.parametrize("planner", list_planners(), ids=lambda planner: planner.name)
@pytest.mark.parametrize(("goal", "expected"), GOALS)
def test_an_open_goal_counts_everybody(goal: Condition, expected: list[str], planner: Planner) -> None:
    answer = solve(library(DRIVE, PICK, LIFT), LAB, goal, (planner,))
    assert isinstance(answer, Solved) and answer.optimal == "proven", answer
    assert [each.skill for each in answer.plan.steps] == expected


def test_of_a_part_of_the_scene_nothing_is_claimed_about_who_was_left_out() -> None:
    goal = And((FULL, Not(Holds(ROBOT, AT, Anything()))))
    narrow = solve(library(DRIVE, PICK, LIFT), LAB, goal, size=AbstractionSize(1, 1))
    assert isinstance(narrow, Solved) and narrow.plan.duration_s == 29.5
    whole = solve(library(DRIVE, PICK, LIFT), LAB, goal, size=AbstractionSize(1, 1, proves=True))
    assert isinstance(whole, Solved) and whole.optimal == "proven"


def test_an_open_goal_reads_the_narrower_relations_of_every_kind_of_thing() -> None:
    """Only tools can be kept, and the first individual that may stand at a place is none."""
    kept = RelationTerm(iri=iri("kept"), signatures=(Signature(iri("Tool"), iri("Place")),), parents=(AT,))
    vocabulary = msgspec.structs.replace(VOCABULARY, relations={**VOCABULARY.relations, kept.iri: kept})
    people = [AddIndividual(iri(name), (iri(cls),)) for name, cls in (("a", "Thing1"), ("b", "Tool"), ("p", "Place"))]
    state = WorldState.empty(vocabulary).with_changes(people)
    answer = solve(compiled(KEEP, vocabulary), state, Holds(Anything(), AT, Individual(iri("p"))), (AStar(),))
    assert isinstance(answer, Solved) and answer.optimal == "proven", answer
    assert [each.arguments["x"] for each in answer.plan.steps] == [iri("b")]
