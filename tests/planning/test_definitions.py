"""Relations that a library defines: the world model, the planner and a plain search agree on what follows."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.pipeline import compile as compile_sources
from skillc_dsl.source import Source
from skillc_model.conditions import And, Condition, Holds, Individual, Not
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.plan import GaveUp, Solved, Step, Unsolvable
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import apply_step
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.world_state import WorldState

TEXT = """use sumo
class Holder < Object
class Place < Holder
class Ware < Object
class Tray < Ware, Holder
relation lies(Object, Object)  functional
property isOpen(Tray): Bool

relation standsIn(x: Object, p: Object) = x lies p or exists t: Tray (x lies t and t lies p)
relation isSafe(x: Ware, p: Place) = x standsIn p and not exists t: Tray (x lies t and t.isOpen == true)
relation inside(x: Object, h: Holder) = x lies h or exists m: Holder (x lies m and m inside h)
relation near(x: Object, y: Object) = exists p: Place (x inside p and y inside p and not x == y)

## Move `what` into `to`.
skill Move {
    in    what: Ware
    infer from: Holder
    in    to:   Holder
    pre   what lies from
    pre   not to == what and not to == from
    pre   not to standsIn what
    post  what lies to
    duration 1 s
}

## Close `tray`, which must stand in a place.
skill Close {
    in   tray:  Tray
    in   place: Place
    pre  tray standsIn place
    post tray.isOpen == false
    duration 1 s
}
## Close all that stands in `place`.
skill CloseAll {
    in   place: Place
    pre  exists w: Ware (w standsIn place)
    post forall t: Tray (t.isOpen == false when t standsIn place)
    duration 3 s
}
impl close of CloseAll { run python "skillc.primitives:StandIn" }
impl move of Move { run python "skillc.primitives:StandIn" }
impl close of Close { run python "skillc.primitives:StandIn" }
"""
NS = "https://w3id.org/skillc/library/defined#"
Lies = dict[str, str]
State = tuple[Lies, frozenset[str]]
"""What lies where, and which trays are open."""


def compile_text(text: str) -> SkillLibrary:
    outcome = compile_sources([Source("defined.skill", text)], load_vocabulary(), {}, "defined", {})
    assert not outcome.diagnostics, outcome.diagnostics
    return outcome.value


LIBRARY = compile_text(TEXT)


def world(library: SkillLibrary, lies: Lies, open_: frozenset[str]) -> WorldState:
    classes = {"P": "Place", "T": "Tray", "W": "Ware"}
    things = sorted({*lies, *lies.values(), "P1", "P2"})
    changes: list[Change] = [AddIndividual(NS + each, (NS + classes[each[0]],)) for each in things]
    changes += [AddRelation(NS + one, NS + "lies", NS + other) for one, other in lies.items()]
    changes += [SetProperty(NS + each, NS + "isOpen", each in open_) for each in things if each[0] == "T"]
    return WorldState.empty(library.vocabulary).with_changes(changes)


def is_so(relation: str, x: str, y: str, state: State) -> bool:
    lies, open_ = state
    at = lies.get(x)
    match relation:
        case "standsIn":
            return at == y or (at is not None and at[0] == "T" and lies.get(at) == y)
        case "isSafe":
            return y[0] == "P" and is_so("standsIn", x, y, state) and at not in open_
        case "inside":
            return y in above(x, lies)
        case _:
            return x != y and any(each[0] == "P" and each in above(y, lies) for each in above(x, lies))


def above(thing: str, lies: Lies) -> set[str]:
    found, at = set[str](), lies.get(thing)
    while at is not None and at not in found:
        found.add(at)
        at = lies.get(at)
    return found


def steps_from(state: State) -> Iterator[State]:
    lies, open_ = state
    for what in lies:
        for to in sorted({*lies, "P1", "P2"}):
            if to[0] != "W" and to not in (what, lies[what]) and not is_so("standsIn", to, what, state):
                yield {**lies, what: to}, open_
    for tray in sorted(open_):
        if any(is_so("standsIn", tray, place, state) for place in ("P1", "P2")):
            yield lies, open_ - {tray}


def search(state: State, goals: list[tuple[str, str, str, bool]]) -> int | None:
    """Return the number of steps of the shortest plan, by breadth-first search; None if there is none."""
    waiting = deque([(state, 0)])
    seen = {(tuple(state[0].items()), state[1])}
    while waiting:
        now, steps = waiting.popleft()
        if all(is_so(relation, x, y, now) is wanted for relation, x, y, wanted in goals):
            return steps
        for after in steps_from(now):
            key = tuple(after[0].items()), after[1]
            if key not in seen:
                seen.add(key)
                waiting.append((after, steps + 1))
    return None


@st.composite
def problems(draw: st.DrawFn) -> tuple[State, list[tuple[str, str, str, bool]]]:
    lies: Lies = {}
    for name in [*(f"T{n}" for n in range(draw(st.integers(0, 2)))), "W1", "W2"][: draw(st.integers(1, 4))]:
        lies[name] = draw(st.sampled_from([each for each in ("P1", "P2", *lies) if each[0] != "W"]))
    trays = [each for each in lies if each[0] == "T"]
    open_ = frozenset(each for each in trays if draw(st.booleans()))
    goals = []
    for _ in range(draw(st.integers(1, 2))):
        relation = draw(st.sampled_from(("standsIn", "isSafe", "inside", "near")))
        x = draw(st.sampled_from(sorted(lies)))
        ends = {"isSafe": ["P1", "P2"], "near": sorted(lies)}.get(relation, ["P1", "P2", *trays])
        wanted = relation in ("inside", "near") or draw(st.booleans())
        goals.append((relation, x, draw(st.sampled_from(ends)), wanted))
    return (lies, open_), goals


def as_goal(goals: list[tuple[str, str, str, bool]]) -> Condition:
    held = ((Holds(Individual(NS + x), NS + relation, Individual(NS + y)), wanted) for relation, x, y, wanted in goals)
    return And(tuple(each if wanted else Not(each) for each, wanted in held))


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(problems())
def test_planner_world_and_search_agree(problem: tuple[State, list[tuple[str, str, str, bool]]]) -> None:
    (lies, open_), goals = problem
    state = world(LIBRARY, lies, open_)
    for relation in ("standsIn", "isSafe", "inside", "near"):
        found = {(x.removeprefix(NS), y.removeprefix(NS)) for x, y in state.pairs(NS + relation)}
        things = sorted({*lies, "P1", "P2"})
        assert found == {(x, y) for x in things for y in things if is_so(relation, x, y, (lies, open_))}
    answer, expected = solve(LIBRARY, state, as_goal(goals), (AStar(),)), search((lies, open_), goals)
    if expected is None:
        assert isinstance(answer, Unsolvable | GaveUp), answer
        return
    assert isinstance(answer, Solved), answer
    assert len(answer.plan.steps) == expected
    for step in answer.plan.steps:
        state = apply_step(step, LIBRARY, state)
    assert evaluate(as_goal(goals), state, {})


@st.composite
def graphs(draw: st.DrawFn) -> Lies:
    """Draw what lies in what, in circles, too."""
    things = [f"T{n}" for n in range(draw(st.integers(1, 6)))]
    return {each: draw(st.sampled_from(["P1", *things])) for each in things if draw(st.booleans())}


MUTUAL = TEXT.replace(
    "relation near",
    """relation isEven(x: Object, h: Holder) = x == h or exists m: Holder (x lies m and m isOdd h)
relation isOdd(x: Object, h: Holder) = exists m: Holder (x lies m and m isEven h)
relation twice(x: Object, h: Holder) = x lies h or exists m: Holder (x twice m and m twice h)
relation outside(x: Object, h: Holder) = not x twice h
relation near""",
)


@settings(deadline=None, max_examples=30)
@given(graphs())
def test_the_least_relation_that_fulfils_a_definition_holds(lies: Lies) -> None:
    state = world(compile_mutual(), lies, frozenset())
    things = sorted({*lies, *lies.values(), "P1", "P2"})
    for x in things:
        at, even, odd, number = x, {x}, set[str](), 0
        while at in lies and number <= 2 * len(things):
            at, number = lies[at], number + 1
            (odd if number % 2 else even).add(at)
        for y in [each for each in things if each[0] != "W"]:
            held = {name for name in ("isEven", "isOdd", "twice", "outside") if state.holds(NS + x, NS + name, NS + y)}
            inside = y in above(x, lies)
            expected = {"twice" if inside else "outside"}
            expected |= {"isEven"} if y in even else set()
            expected |= {"isOdd"} if y in odd else set()
            assert held == expected, (x, y, lies)


MADE: list[SkillLibrary] = []


def compile_mutual() -> SkillLibrary:
    if not MADE:
        MADE.append(compile_text(MUTUAL))
    return MADE[0]


@pytest.mark.slow
def test_what_is_not_within_at_any_depth_is_planned_where_the_scene_is_small() -> None:
    goal = as_goal([("inside", "W1", "P1", False)])
    small, large = world(LIBRARY, {"W1": "P1"}, frozenset()), world(LIBRARY, {"W1": "P1", "T1": "P1"}, frozenset())
    answer = solve(LIBRARY, small, goal, (AStar(),))
    assert isinstance(answer, Solved) and answer.optimal == "proven" and len(answer.plan.steps) == 1
    refused = solve(LIBRARY, large, goal, (AStar(),))
    assert isinstance(refused, GaveUp) and "leads back to itself" in str(refused)


@pytest.mark.slow
def test_where_longer_chains_are_possible_than_are_planned_with_nothing_is_proved() -> None:
    lies = {"W1": "P1", **{f"T{number}": "P2" for number in range(4)}}
    answer = solve(LIBRARY, world(LIBRARY, lies, frozenset()), as_goal([("inside", "W1", "P2", True)]), (AStar(),))
    assert isinstance(answer, Solved) and len(answer.plan.steps) == 1
    assert [each.what for each in answer.left_out if each.kind == "chains"] == [("longer chains",)]


@pytest.mark.slow
def test_an_effect_on_many_may_ask_for_it() -> None:
    state = world(LIBRARY, {"W1": "P1", "T1": "P1", "T2": "T1", "T3": "P2"}, frozenset({"T1", "T2", "T3"}))
    closed = And(tuple(as_goal([("isSafe", each, "P1", True)]) for each in ("T2", "W1")))
    answer = solve(LIBRARY, state, closed, (AStar(),))
    assert isinstance(answer, Solved), answer
    after = state
    for step in answer.plan.steps:
        after = apply_step(step, LIBRARY, after)
    assert evaluate(closed, after, {})
    all_closed = apply_step(Step("CloseAll", {"place": NS + "P1"}), LIBRARY, state)
    assert [all_closed.value(NS + each, NS + "isOpen") for each in ("T1", "T2", "T3")] == [False, False, True]


def test_a_relation_that_does_not_hold_says_what_is_missing() -> None:
    state = world(LIBRARY, {"W1": "T1", "T1": "P1"}, frozenset({"T1"}))
    reasons = state.axioms.computed[NS + "isSafe"], state.axioms.computed[NS + "inside"]
    assert (
        reasons[0].obstacle(state, NS + "W1", NS + "P1") == "defined:W1 lies defined:T1 and defined:T1.isOpen is true"
    )
    assert "lies" in (reasons[1].obstacle(state, NS + "W1", NS + "P2") or "")
