"""Chains of facts that skills change, such as what is within what: planner, world model and a plain search agree."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import NamedTuple

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.pipeline import compile as compile_sources
from skillc_dsl.source import Source
from skillc_model.conditions import And, Compare, Condition, Holds, Individual, Literal, Not, PropertyOf
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.plan import GaveUp, Solved, Unsolvable
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import apply_step
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.terms import CONTAIN, SKILLC
from skillc_runtime.world.state.world_state import WorldState

SKILLS = """
property isSeen(Ware): Bool

skill Move {
    in    what: Ware
    infer from: Holder
    in    to:   Holder
    pre   {from}
    pre   not to == what
    pre   not to {within} what
    post  {to}
    duration 1 s
}
impl move of Move { run python "skillc.primitives:StandIn" }

skill Look {
    in    what:  Ware
    in    place: Shelf
    pre   what {within} place
    post  what.isSeen == true
    duration 1 s
}
impl look of Look { run python "skillc.primitives:StandIn" }
"""
OWN = """use sumo
class Holder < Object
class Place < Holder
class Shelf < Holder
class Ware < Object
class Tray < Ware, Holder
relation inside(Object, Object) transitive
relation lies(Object, Holder) functional sub inside
"""
SHIPPED = """use skiros, skillc
class Place < Location
class Shelf < Container
class Ware < Product
class Tray < Ware, Container
"""
NS = "https://w3id.org/skillc/library/chains#"
FIXED = {"P1": None, "P2": None, "S1": "P1", "S2": "S1"}
"""Places and shelves, which nobody moves, with what they lie in."""

WITHIN = SKILLC + "within"
Lies = dict[str, str | None]


class Words(NamedTuple):
    """A library with the IRIs of its relations; `held` if the second one leads from the holder to what it holds."""

    library: SkillLibrary
    within: str
    step: str
    held: bool


def words(terms: str, held: bool) -> Words:
    said = (
        {"{from}": "from contain what", "{to}": "to contain what", "{within}": "skillc:within"}
        if held
        else {"{from}": "what lies from", "{to}": "what lies to", "{within}": "inside"}
    )
    text = terms + SKILLS
    for old, new in said.items():
        text = text.replace(old, new)
    text = text.replace(": Holder", ": Location") if held else text
    outcome = compile_sources([Source("chains.skill", text)], load_vocabulary(), {}, "chains", {})
    assert not outcome.diagnostics, outcome.diagnostics
    return Words(outcome.value, *((WITHIN, CONTAIN) if held else (NS + "inside", NS + "lies")), held)


WORDS = (words(OWN, held=False), words(SHIPPED, held=True))


def world(lies: Lies, terms: Words) -> WorldState:
    classes = {"P": "Place", "S": "Shelf", "T": "Tray", "W": "Ware"}
    changes: list[Change] = [AddIndividual(NS + each, (NS + classes[each[0]],)) for each in lies]
    pairs = [(to, each) if terms.held else (each, to) for each, to in lies.items() if to is not None]
    changes += [AddRelation(f"{NS}{one}", terms.step, f"{NS}{other}") for one, other in pairs]
    changes += [SetProperty(NS + each, NS + "isSeen", False) for each in lies if each[0] in "TW"]
    return WorldState.empty(terms.library.vocabulary).with_changes(changes)


def within(lies: Lies, thing: str) -> Iterator[str]:
    """Yield all that a thing lies in, from the inside out."""
    at = lies[thing]
    while at is not None:
        yield at
        at = lies[at]


def search(lies: Lies, goals: list[tuple[str, str, bool]], look: str | None) -> int | None:
    """Return the number of steps of the shortest plan, by breadth-first search; None if there is none."""
    movable = [each for each in lies if each[0] in "TW"]
    start = (tuple(lies[each] for each in movable), False)
    waiting, seen = deque([(start, 0)]), {start}
    while waiting:
        (places, looked), steps = waiting.popleft()
        now = {**lies, **dict(zip(movable, places, strict=True))}
        if all((place in within(now, thing)) is wanted for thing, place, wanted in goals) and (look is None or looked):
            return steps
        after = [((places, True), look is not None and any(each[0] == "S" for each in within(now, look)))]
        for index, what in enumerate(movable):
            for to in now:
                free = to[0] != "W" and to != what and what not in within(now, to)
                after.append((((*places[:index], to, *places[index + 1 :]), looked), free and to != places[index]))
        for state, possible in after:
            if possible and state not in seen:
                seen.add(state)
                waiting.append((state, steps + 1))
    return None


@st.composite
def problems(draw: st.DrawFn) -> tuple[Lies, list[tuple[str, str, bool]], str | None]:
    """Draw what lies in what, what shall be within what or not, and what shall be looked at."""
    lies: Lies = dict(FIXED)
    for name in [*(f"T{n}" for n in range(draw(st.integers(0, 2)))), "W1", "W2"][: draw(st.integers(1, 4))]:
        lies[name] = draw(st.sampled_from([each for each in lies if each[0] != "W"]))
    movable = [each for each in lies if each[0] in "TW"]
    places = [each for each in lies if each[0] != "W"]
    goal = st.tuples(st.sampled_from(movable), st.sampled_from(places), st.booleans())
    goal = goal.filter(lambda each: each[0] != each[1])  # planners do not answer where no axiom forbids circles
    return lies, draw(st.lists(goal, min_size=1, max_size=3)), draw(st.none() | st.sampled_from(movable))


@pytest.mark.slow
@settings(deadline=None, max_examples=20)
@given(problems(), st.sampled_from(WORDS))
def test_planner_world_and_search_agree(
    problem: tuple[Lies, list[tuple[str, str, bool]], str | None], terms: Words
) -> None:
    lies, goals, look = problem
    state = world(lies, terms)
    for each in lies:
        inside = {other for other in lies if state.holds(NS + each, terms.within, NS + other)}
        assert inside == set(within(lies, each)), "the world model agrees"
    parts: list[Condition] = []
    for thing, place, wanted in goals:
        held = Holds(Individual(NS + thing), terms.within, Individual(NS + place))
        parts.append(held if wanted else Not(held))
    if look is not None:
        parts.append(Compare(PropertyOf(Individual(NS + look), NS + "isSeen"), "==", Literal(True)))
    answer, expected = solve(terms.library, state, And(tuple(parts)), (AStar(),)), search(lies, goals, look)
    if expected is None:
        assert isinstance(answer, Unsolvable), answer
        return
    assert isinstance(answer, Solved), answer
    assert (len(answer.plan.steps), answer.optimal) == (expected, "proven")
    for step in answer.plan.steps:
        state = apply_step(step, terms.library, state)
    assert all(state.holds(NS + thing, terms.within, NS + place) is wanted for thing, place, wanted in goals)


@pytest.mark.slow
def test_where_longer_chains_are_possible_than_are_planned_with_nothing_is_proved() -> None:
    lies: Lies = {**FIXED, "W1": "P1", **{f"T{number}": "P2" for number in range(4)}}
    terms = WORDS[1]
    goal = Holds(Individual(NS + "W1"), terms.within, Individual(NS + "P2"))
    answer = solve(terms.library, world(lies, terms), goal, (AStar(),))
    assert isinstance(answer, Solved) and len(answer.plan.steps) == 1
    assert answer.optimal == "optimal for the filtered problem"
    assert [each.what for each in answer.left_out if each.kind == "chains"] == [("longer chains",)]


@pytest.mark.parametrize("terms", WORDS, ids=["not irreflexive", "irreflexive"])
def test_whether_a_chain_leads_back_to_where_it_begins_is_not_answered_unless_axioms_do(terms: Words) -> None:
    lies: Lies = {**FIXED, "W1": "P1"}
    ware = Individual(NS + "W1")
    answer = solve(terms.library, world(lies, terms), Holds(ware, terms.within, ware), (AStar(),))
    if terms.held:
        assert isinstance(answer, Unsolvable)
    else:
        assert isinstance(answer, GaveUp) and not answer.searched and "leads back to where it begins" in answer.why
