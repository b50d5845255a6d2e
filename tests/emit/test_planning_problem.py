"""Problems in the planning domain of a library: goals, what is written out for objects, and solving by a planner."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from msgspec import structs

from emit import samples
from emit.planner import search_binary, solve
from emit.samples import PICK, iri, library
from skillc_model.conditions import (
    Compare,
    Condition,
    Exists,
    Forall,
    Holds,
    Individual,
    IsA,
    Literal,
    Not,
    Or,
    PropertyOf,
    Variable,
)
from skillc_model.pddl.domain import ClassMeaning, PlanningDomain, Predicate
from skillc_model.pddl.formulas import (
    FALSE,
    TRUE,
    Atom,
    Formula,
    Negation,
    Typed,
    Universal,
    conjunction,
    conjuncts,
    disjunction,
)
from skillc_model.pddl.goals import ground_goal
from skillc_model.pddl.planning import make_planning_domain
from skillc_model.pddl.preparing.prepare import remove_axioms
from skillc_model.pddl.problem import Problem

needs_planner = pytest.mark.skipif(search_binary() is None, reason="the planner is an extra")

OBJECTS = {
    "ur": "mobile-robot", "arm-1": "compliant-arm", "wsg": "gripper", "dock": "place", "store": "place",
    "wall": "place", "felt": "eraser", "board": "surface",
}  # fmt: skip
FACTS = (
    "core-at ur dock", "has-a ur arm-1", "has-a arm-1 wsg", "contain store felt", "contain wall board",
    "guard-pick-light felt", "guard-pick-ready arm-1", "guard-wipe-ready arm-1", "is-compliant-arm arm-1",
)  # fmt: skip


def problem(domain: PlanningDomain, goal: Formula) -> Problem:
    init = tuple(Atom(name, tuple(terms)) for name, *terms in (fact.split() for fact in FACTS))
    objects = tuple(Typed(name, type_) for name, type_ in OBJECTS.items())
    names = {name: iri(name) for name in OBJECTS}
    return Problem("sample", domain, objects, names, init, (), goal)


@needs_planner
def test_the_planner_fetches_the_eraser_and_wipes(tmp_path: Path) -> None:
    goal = Atom("is-clean", ("board",))
    plan = solve(remove_axioms(problem(make_planning_domain(samples.wiping()), goal)), tmp_path)
    assert plan == [
        "drive ur store dock",
        "pick arm-1 felt ur wsg store",
        "drive ur wall store",
        "wipe board arm-1 wsg felt ur wall",
    ]


@needs_planner
def test_a_disjunctive_goal_is_reached_by_its_cheapest_case(tmp_path: Path) -> None:
    made = samples.wiping()
    domain = make_planning_domain(made)
    wanted = Or(
        (
            Holds(Individual(iri("ur")), iri("at"), Individual(iri("wall"))),
            Compare(PropertyOf(Individual(iri("board")), iri("isClean")), "==", Literal(True)),
        )
    )
    objects = {iri(name): Typed(name, type_) for name, type_ in OBJECTS.items()}
    goal = ground_goal(wanted, made, domain, objects, lambda _: (), lambda _: False)
    assert solve(remove_axioms(problem(domain, goal)), tmp_path) == ["drive ur wall dock", "reach-goal"]


def test_forall_is_written_out_for_the_objects() -> None:
    before = problem(make_planning_domain(library(PICK)), TRUE)
    after = remove_axioms(before)
    empty = {
        each.body.terms[1]
        for each in conjuncts(after.domain.action["pick"].precondition)
        if isinstance(each, Negation) and isinstance(each.body, Atom)
    }
    assert empty == set(OBJECTS)
    assert after.domain.constants == before.objects


def test_what_nothing_changes_is_settled_where_forall_is_written_out() -> None:
    """A planner multiplies out what would be left of each object, so that a few of them are a million cases."""
    domain = make_planning_domain(library(PICK))
    pick, place = domain.action["pick"], Typed("?place", "place")
    fixed = Predicate("is-fixed", (place,), ClassMeaning("fixed"), False)
    at_place = Atom("core-at", (pick.parameters[0].name, place.name))
    every = Universal(place, disjunction((Negation(Atom("is-fixed", (place.name,))), at_place)))
    actions = (structs.replace(pick, precondition=every),)
    before = problem(replace(domain, predicates=(*domain.predicates, fixed), actions=actions), TRUE)
    for fixed_ones in ((), ("dock",), ("dock", "wall")):
        facts = tuple(Atom("is-fixed", (name,)) for name in fixed_ones)
        after = remove_axioms(structs.replace(before, init=(*before.init, *facts))).domain.action["pick"].precondition
        assert after == conjunction(Atom("core-at", (at_place.terms[0], name)) for name in fixed_ones)


def test_goals_are_ground_and_settle_what_never_changes() -> None:
    made = samples.wiping()
    domain = make_planning_domain(made)
    objects = {iri(name): Typed(name, type_) for name, type_ in OBJECTS.items()}
    places = [iri("store"), iri("wall")]

    def goal(condition: Condition, holds_now: bool = False) -> Formula:
        return ground_goal(condition, made, domain, objects, lambda _: places, lambda _: holds_now)

    robot = Individual(iri("ur"))
    somewhere = Exists("x", iri("Place"), Holds(robot, iri("at"), Variable("x")))
    everywhere = Forall("x", iri("Place"), Holds(robot, iri("at"), Variable("x")))
    atoms = (Atom("core-at", ("ur", "store")), Atom("core-at", ("ur", "wall")))
    assert goal(somewhere).parts == atoms  # type: ignore[union-attr]
    assert goal(everywhere).parts == atoms  # type: ignore[union-attr]
    assert goal(Not(somewhere)).parts == tuple(Negation(each) for each in atoms)  # type: ignore[union-attr]
    assert goal(IsA(robot, iri("Robot")), holds_now=True) == TRUE
    assert goal(IsA(robot, iri("Robot"))) == FALSE
