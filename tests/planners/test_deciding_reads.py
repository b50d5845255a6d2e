"""What a condition reads decides it: as long as these facts stay, it keeps its value, whatever else changes."""

from __future__ import annotations

from itertools import product

from hypothesis import given
from hypothesis import strategies as st

from planners.job_shops import SHOP
from planners.test_job_shops import library
from skillc_model.conditions import (
    And,
    Compare,
    Condition,
    Exists,
    Forall,
    Holds,
    Individual,
    Literal,
    Not,
    Or,
    PropertyOf,
    Same,
    Variable,
)
from skillc_model.read_write import FactPattern
from skillc_runtime.planning.deciding_reads import DecidingReads
from skillc_runtime.planning.world_changes import find_changed_facts
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, SetProperty
from skillc_runtime.world.state.world_state import WorldState

NAMES = tuple(SHOP + each for each in "abc")
OPERATION, PRECEDES, DONE = (SHOP + each for each in ("Operation", "precedes", "isDone"))
EVERYTHING = (FactPattern(PRECEDES), FactPattern(DONE))

TERMS = st.sampled_from([*map(Individual, NAMES), Variable("x"), Variable("y")])
LEAVES = st.one_of(
    st.builds(Holds, TERMS, st.just(PRECEDES), TERMS),
    st.builds(lambda term, value: Compare(PropertyOf(term, DONE), "==", Literal(value)), TERMS, st.booleans()),
    st.builds(Same, TERMS, TERMS),
)


def compose(parts: st.SearchStrategy[Condition]) -> st.SearchStrategy[Condition]:
    pairs, names = st.tuples(parts, parts), st.sampled_from("xy")
    return st.one_of(
        st.builds(Not, parts),
        st.builds(And, pairs),
        st.builds(Or, pairs),
        st.builds(Exists, names, st.just(OPERATION), parts),
        st.builds(Forall, names, st.just(OPERATION), parts),
    )


CONDITIONS = st.recursive(LEAVES, compose, max_leaves=6)
PAIRS = st.sets(st.sampled_from(list(product(NAMES, NAMES))))
WORLDS = st.tuples(PAIRS, st.sets(st.sampled_from(NAMES)))


def world(drawn: tuple[set[tuple[str, str]], set[str]]) -> WorldState:
    pairs, done = drawn
    changes = [
        *(AddIndividual(each, (OPERATION,)) for each in NAMES),
        *(AddRelation(one, PRECEDES, other) for one, other in pairs),
        *(SetProperty(each, DONE, True) for each in done),
    ]
    return WorldState.empty(library().vocabulary).with_changes(changes)


@given(CONDITIONS, WORLDS, WORLDS)
def test_a_condition_keeps_its_value_while_what_it_reads_stays(
    condition: Condition,
    before: tuple[set[tuple[str, str]], set[str]],
    other: tuple[set[tuple[str, str]], set[str]],
) -> None:
    bindings = {"x": NAMES[0], "y": NAMES[1]}
    one = world(before)
    reads = DecidingReads(EVERYTHING).find(condition, one, bindings)
    kept = (
        {pair for pair in other[0] if not _is_read(FactPattern(PRECEDES, *pair), reads)}
        | {pair for pair in before[0] if _is_read(FactPattern(PRECEDES, *pair), reads)},
        {each for each in other[1] if not _is_read(FactPattern(DONE, each), reads)}
        | {each for each in before[1] if _is_read(FactPattern(DONE, each), reads)},
    )
    two = world(kept)
    assert not any(_is_read(each, reads) for each in find_changed_facts(one, two))
    assert evaluate(condition, two, bindings) == evaluate(condition, one, bindings)


def _is_read(fact: FactPattern, reads: frozenset[FactPattern]) -> bool:
    return any(each.meets(fact) for each in reads)


def test_one_individual_is_enough_for_exists_and_what_nobody_writes_is_not_read() -> None:
    done = Compare(PropertyOf(Variable("o"), DONE), "==", Literal(True))
    state = world((set(), {NAMES[1], NAMES[2]}))
    some = Exists("o", OPERATION, done)
    assert DecidingReads(EVERYTHING).find(some, state, {}) == {FactPattern(DONE, NAMES[1])}
    assert DecidingReads([FactPattern(DONE, NAMES[1])]).find(some, state, {}) == frozenset()
    every = Forall("o", OPERATION, Or((Not(Holds(Variable("o"), PRECEDES, Individual(NAMES[0]))), done)))
    assert DecidingReads([FactPattern(DONE, each) for each in NAMES]).find(every, state, {}) == frozenset()
