"""Nested quantifiers mean what trying every individual says, whatever order they are evaluated in."""

from __future__ import annotations

import os
from contextlib import suppress
from functools import reduce

import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st

from skillc_model.blocks import narrow_scopes
from skillc_model.conditions import (
    And,
    Arithmetic,
    Compare,
    Condition,
    Exists,
    Forall,
    Given,
    Holds,
    Individual,
    Invoke,
    IsA,
    Literal,
    Not,
    Or,
    PropertyOf,
    Same,
    Variable,
)
from skillc_runtime.cancellation import Cancelled, CancelToken, cancelling
from skillc_runtime.world.eval.conditions import compile_condition, evaluate
from skillc_runtime.world.eval.deciding_facts import deciding_facts
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.expressions import Bindings
from skillc_runtime.world.eval.grounds import find_grounds
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState
from world.lab import SCENE, assign, fact, individual, iri

EXAMPLES = int(os.environ.get("SKILLC_QUANTIFIERS", "60"))
"""How many random conditions are evaluated; thousands on occasion."""

NAMES = ("x", "y", "z", "passed", "unset")
PASSED: Bindings = {"passed": iri("shelf"), "unset": None}
ERROR = "error"

names = st.sampled_from(("x", "x", "y", "y", "z", "z", "passed", "unset")).map(Variable)
terms = st.one_of(names, names, st.just(Individual(iri("table"))))
relations = st.sampled_from(("contain", "containedIn", "beside", "within-it")).map(iri)
classes = st.sampled_from(("Location", "Product", "Holder", "Thing")).map(iri)
weights = names.map(lambda name: PropertyOf(name, iri("weight")))
comparisons = st.builds(Compare, weights, st.sampled_from(("<", ">=")), st.just(Literal(1.5)))
failing = st.one_of(
    weights.map(lambda weight: Compare(Arithmetic("/", Literal(1.0), weight), ">", Literal(0.6))),
    st.just(Compare(Invoke("broken", ()), ">", Literal(0.0))),
    names.map(lambda name: Compare(PropertyOf(name, iri("load")), ">=", Literal(1))),
)
leaves = st.one_of(
    st.builds(Holds, names, relations, terms),
    st.builds(Holds, terms, relations, names),
    st.builds(Same, names, terms),
    st.builds(IsA, names, classes),
    st.just(Given("unset")),
    comparisons,
    failing,
)
bound = st.sampled_from(("x", "y", "z"))


def _several(kind: type[And] | type[Or]) -> st.SearchStrategy[Condition]:
    return st.lists(bodies, min_size=1, max_size=3).map(tuple).map(kind)


bodies: st.SearchStrategy[Condition] = st.deferred(
    lambda: st.one_of(
        leaves,
        leaves,
        bodies.map(Not),
        _several(And),
        _several(Or),
        st.builds(Exists, bound, classes, bodies),
        st.builds(Forall, bound, classes, bodies),
    )
)
prefixes = st.lists(st.tuples(st.sampled_from((Exists, Forall)), bound, classes), min_size=2, max_size=3)
conditions = st.builds(
    lambda prefix, body: reduce(lambda inner, each: each[0](each[1], each[2], inner), prefix, body),
    prefixes,
    _several(And),
)
added = (individual("place-1", "Location"), individual("part-1", "Product"))
facts = st.one_of(
    st.builds(
        fact, st.sampled_from(("table", "shelf", "place-1")), st.just("contain"), st.sampled_from(("box", "part-1"))
    ),
    st.builds(fact, st.sampled_from(("table", "shelf")), st.just("beside"), st.sampled_from(("table", "place-1"))),
    st.builds(assign, st.sampled_from(("box", "eraser", "part-1")), st.just("weight"), st.sampled_from((0, 1.0, 2.0))),
)
scenes = st.lists(facts, max_size=6).map(lambda changes: SCENE.with_changes((*added, *changes)))


@given(scenes, conditions)
@settings(max_examples=EXAMPLES)
def test_a_condition_has_the_value_that_trying_all_individuals_gives(state: WorldState, condition: Condition) -> None:
    possible = outcomes(condition, state, dict(PASSED))
    try:
        value: bool | str = evaluate(condition, state, PASSED)
    except EvaluationError:
        value = ERROR
    event(f"{len(possible)} outcomes, {value}")
    assert value in possible or ERROR in possible
    with suppress(EvaluationError):  # parts that guard others may come after them
        assert evaluate(narrow_scopes(condition), state, PASSED) == value or ERROR in possible


Outcomes = frozenset[bool | str]


def outcomes(condition: Condition, state: WorldState, bindings: Bindings) -> Outcomes:
    """Return the possible results, with errors, of trying individuals in any order and parts in that of the text."""
    match condition:
        case Not(body):
            return frozenset(each if isinstance(each, str) else not each for each in outcomes(body, state, bindings))
        case And(parts):
            return _in_order([outcomes(part, state, bindings) for part in parts], False)
        case Or(parts):
            return _in_order([outcomes(part, state, bindings) for part in parts], True)
        case Exists(variable, cls, body) | Forall(variable, cls, body):
            members = [outcomes(body, state, {**bindings, variable: each}) for each in state.instances(cls)]
            decisive = isinstance(condition, Exists)
            ends = {each for member in members for each in member if each != (not decisive)}
            return frozenset(ends | ({not decisive} if all((not decisive) in each for each in members) else set()))
        case _:
            try:
                return frozenset({compile_condition(condition)(state, bindings)})
            except EvaluationError:
                return frozenset({ERROR})


def _in_order(parts: list[Outcomes], decisive: bool) -> Outcomes:
    found: set[bool | str] = set()
    for part in parts:
        found |= part - {not decisive}
        if (not decisive) not in part:
            return frozenset(found)
    return frozenset({*found, not decisive})


def _shops(count: int) -> WorldState:
    """Return places, each beside all others."""
    places = [f"place-{number}" for number in range(count)]
    near = (fact(one, "near", other) for one in places for other in places)
    return SCENE.with_changes((*(individual(each, "Location") for each in places), *near))


def _chain(length: int, last: Condition) -> Condition:
    """Return the condition that a chain of places ends as `last` says; all quantifiers stand first."""
    steps = [Holds(Variable(f"x{i}"), iri("near"), Variable(f"x{i + 1}")) for i in range(length - 1)]
    condition: Condition = And((last, *reversed(steps)))
    for number in reversed(range(length)):
        condition = Exists(f"x{number}", iri("Location"), condition)
    return condition


@pytest.mark.parametrize("wanted", [True, False])
def test_the_time_does_not_grow_with_the_depth_of_quantifiers(wanted: bool) -> None:
    last = Holds(Variable("x29"), iri("contain"), Individual(iri("box" if wanted else "board")))
    state = _shops(30).with_changes([fact("place-3", "contain", "box")])
    assert evaluate(_chain(30, last), state, {}) is wanted  # 30 ** 30 combinations


def test_quantifiers_that_alternate_are_evaluated_once_for_what_they_read() -> None:
    condition: Condition = Holds(Variable("x11"), iri("contain"), Individual(iri("board")))
    for number in reversed(range(1, 12)):
        link = Holds(Variable(f"x{number - 1}"), iri("near"), Variable(f"x{number}"))
        some = Exists(f"x{number}", iri("Location"), And((link, condition)))
        every = Forall(f"x{number}", iri("Location"), Or((Not(link), condition)))
        condition = some if number % 2 else every
    assert not evaluate(Exists("x0", iri("Location"), condition), _shops(20), {})  # 20 ** 12 combinations


def test_a_search_that_takes_long_ends_when_its_time_is_up() -> None:
    names = [f"x{number}" for number in range(9)]
    apart = [Not(Same(Variable(one), Variable(two))) for one in names for two in names if one < two]
    condition: Condition = And((*apart, Not(IsA(Variable("x8"), iri("Location")))))
    for name in names:
        condition = Exists(name, iri("Location"), condition)
    with cancelling(CancelToken(0.05)), pytest.raises(Cancelled):
        evaluate(condition, _shops(40), {})


def test_what_decides_nested_quantifiers_is_found_without_trying_all_combinations() -> None:
    state = _shops(4)
    last = Holds(Variable("x9"), iri("contain"), Individual(iri("board")))
    condition = _chain(10, last)  # 6 ** 10 combinations
    assert not evaluate(condition, state, {})
    assert "none of" in explain(condition, state, {}, state.vocabulary)
    assert not deciding_facts([condition], state, {})  # nothing contains the board
    assert find_grounds(condition, WorldModel(state), {})
    possible = _chain(10, Holds(Variable("x8"), iri("near"), Variable("x9")))
    assert deciding_facts([possible], state, {})
