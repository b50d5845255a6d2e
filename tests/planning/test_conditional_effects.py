"""Effects on all individuals that fulfil a condition: the planner, the world model and a plain search agree."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc.cli.main import skillc
from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.pipeline import compile as compile_sources
from skillc_dsl.source import Source
from skillc_model.conditions import And, Compare, Condition, Holds, Individual, Literal, PropertyOf
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.arrangement import arrange_plan, step_numbers
from skillc_runtime.planning.plan import Solved, Step, Unsolvable
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import apply_step
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.world_state import WorldState

TEXT = """use sumo
class Place < Object
class Tray < Object  disjoint Place
class Cup < Object  disjoint Tray, Place
relation lies(Object, Object)  functional
property isEmpty(Cup): Bool
property isOpen(Cup): Bool

## Move `tray`: what lies on it open is spilled.
skill Move {
    in    tray: Tray
    in    to:   Place
    infer from: Place
    pre   tray lies from
    pre   not to == from
    post  tray lies to
    post  spilled: forall c: Cup (c.isEmpty == true when c lies tray and c.isOpen == true)
    duration 1 s
}

## Put all that lies on `tray` down.
skill Unload {
    in    tray:  Tray
    infer place: Place
    pre   tray lies place
    post  forall c: Cup (c lies place when c lies tray)
    duration 1 s
}

## Collect what lies in a place on `tray`.
skill Load {
    in    tray:  Tray
    infer place: Place
    pre   tray lies place
    post  forall c: Cup (c lies tray when c lies place)
    duration 1 s
}

## Turn the lids of all.
skill Turn {
    in   tray: Tray
    post forall c: Cup (c.isOpen == false when c.isOpen == true and c lies tray)
    post forall c: Cup (c.isOpen == true when c.isOpen == false and c lies tray)
    duration 1 s
}

## Fill every cup.
skill FillAll {
    in   place: Place
    pre  exists c: Cup (c lies place)
    post forall c: Cup (c.isEmpty == false)
    duration 1 s
}
impl one of Move { run python "skillc.primitives:StandIn" }
impl one of Unload { run python "skillc.primitives:StandIn" }
impl one of Load { run python "skillc.primitives:StandIn" }
impl one of Turn { run python "skillc.primitives:StandIn" }
impl one of FillAll { run python "skillc.primitives:StandIn" }
"""
NS = "https://w3id.org/skillc/library/effects#"


class State(NamedTuple):
    """Where things lie, which cups are empty, and which are open."""

    lies: tuple[tuple[str, str], ...]
    empty: frozenset[str]
    open: frozenset[str]

    @property
    def cups(self) -> list[str]:
        return [each for each, _ in self.lies if each[0] == "C"]


def compile_text(text: str) -> SkillLibrary:
    outcome = compile_sources([Source("effects.skill", text)], load_vocabulary(), {}, "effects", {})
    assert not outcome.diagnostics, outcome.diagnostics
    return outcome.value


LIBRARY = compile_text(TEXT)


def world(state: State) -> WorldState:
    classes = {"P": "Place", "T": "Tray", "C": "Cup"}
    things = sorted({"P1", "P2", *(each for each, _ in state.lies)})
    changes: list[Change] = [AddIndividual(NS + each, (NS + classes[each[0]],)) for each in things]
    changes += [AddRelation(NS + one, NS + "lies", NS + other) for one, other in state.lies]
    changes += [SetProperty(NS + each, NS + "isEmpty", each in state.empty) for each in state.cups]
    changes += [SetProperty(NS + each, NS + "isOpen", each in state.open) for each in state.cups]
    return WorldState.empty(LIBRARY.vocabulary).with_changes(changes)


def steps_from(state: State) -> Iterator[State]:
    at, cups = dict(state.lies), state.cups
    for tray, place in [(one, other) for one, other in state.lies if one[0] == "T"]:
        here = {each for each in cups if at[each] == tray}
        there = {each for each in cups if at[each] == place}
        for to in {"P1", "P2"} - {place}:
            yield State(_moved(at, {tray}, to), state.empty | (here & state.open), state.open)
        yield State(_moved(at, here, place), state.empty, state.open)
        yield State(_moved(at, there, tray), state.empty, state.open)
        yield State(state.lies, state.empty, state.open ^ here)
    if any(at[each] in ("P1", "P2") for each in cups):
        yield State(state.lies, frozenset(), state.open)


def _moved(at: dict[str, str], things: set[str], to: str) -> tuple[tuple[str, str], ...]:
    return tuple((each, to if each in things else place) for each, place in at.items())


def reached(state: State, goal: State, asked: list[str]) -> bool:
    return all(
        dict(state.lies)[each] == dict(goal.lies)[each]
        and (each[0] != "C" or (each in state.empty) == (each in goal.empty))
        for each in asked
    )


def search(start: State, goal: State, asked: list[str]) -> int | None:
    """Return the number of steps of the shortest plan, by breadth-first search; None if there is none."""
    waiting, seen = deque([(start, 0)]), {start}
    while waiting:
        state, steps = waiting.popleft()
        if reached(state, goal, asked):
            return steps
        for after in steps_from(state):
            if after not in seen:
                seen.add(after)
                waiting.append((after, steps + 1))
    return None


@st.composite
def states(draw: st.DrawFn, things: tuple[str, ...]) -> State:
    trays = [each for each in things if each[0] == "T"]
    lies = [(each, draw(st.sampled_from(["P1", "P2"] if each[0] == "T" else ["P1", "P2", *trays]))) for each in things]
    cups = [each for each in things if each[0] == "C"]
    empty, open_ = (frozenset(each for each in cups if draw(st.booleans())) for _ in range(2))
    return State(tuple(lies), empty, open_)


@st.composite
def problems(draw: st.DrawFn) -> tuple[State, State, list[str]]:
    things = ("T1", *(("T2",) if draw(st.booleans()) else ()), "C1", *(("C2",) if draw(st.booleans()) else ()))
    asked = draw(st.lists(st.sampled_from(things), min_size=1, max_size=3, unique=True))
    return draw(states(things)), draw(states(things)), asked


def as_goal(goal: State, asked: list[str]) -> Condition:
    parts: list[Condition] = []
    for each in asked:
        parts.append(Holds(Individual(NS + each), NS + "lies", Individual(NS + dict(goal.lies)[each])))
        if each[0] == "C":
            empty = PropertyOf(Individual(NS + each), NS + "isEmpty")
            parts.append(Compare(empty, "==", Literal(each in goal.empty)))
    return And(tuple(parts))


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(problems())
def test_planner_world_and_search_agree(problem: tuple[State, State, list[str]]) -> None:
    start, goal, asked = problem
    state, wanted = world(start), as_goal(goal, asked)
    answer, expected = solve(LIBRARY, state, wanted, (AStar(),)), search(start, goal, asked)
    if expected is None:
        assert isinstance(answer, Unsolvable), answer
        return
    assert isinstance(answer, Solved), answer
    assert (len(answer.plan.steps), answer.optimal) == (expected, "proven")
    order = step_numbers(arrange_plan(answer.plan, LIBRARY, state))
    for number in order:
        state = apply_step(answer.plan.steps[number], LIBRARY, state)
    assert evaluate(wanted, state, {})


@given(states(("T1", "T2", "C1", "C2", "C3")))
@settings(deadline=None, max_examples=30)
def test_a_step_changes_what_the_text_says(start: State) -> None:
    found = {read(apply_step(each, LIBRARY, world(start)), start) for each in all_steps(start)}
    assert found == set(steps_from(start))


def all_steps(state: State) -> Iterator[Step]:
    for tray, place in [(one, other) for one, other in state.lies if one[0] == "T"]:
        for to in {"P1", "P2"} - {place}:
            yield step("Move", tray=tray, to=to, start=place)
        yield step("Unload", tray=tray, place=place)
        yield step("Load", tray=tray, place=place)
        yield step("Turn", tray=tray)
    for place in {at for each, at in state.lies if each[0] == "C" and at[0] == "P"}:
        yield step("FillAll", place=place)


def step(skill: str, **arguments: str) -> Step:
    return Step(skill, {name.replace("start", "from"): NS + each for name, each in arguments.items()})


def read(state: WorldState, like: State) -> State:
    lies = tuple((each, min(state.objects(NS + each, NS + "lies")).removeprefix(NS)) for each, _ in like.lies)
    empty, open_ = (
        frozenset(each for each in like.cups if state.value(NS + each, NS + name)) for name in ("isEmpty", "isOpen")
    )
    return State(lies, empty, open_)


RUNS = (
    TEXT
    + """prefix lab: <http://example.org/lab#>

test what_is_open_is_spilled {
    scene  "hall.ttl"
    start  forall c: Cup (c.isOpen == true)
    do     Move(tray: lab:T1, to: lab:P2)
    expect lab:C1.isEmpty == true and lab:C2.isEmpty == false
}

test all_of_it_is_planned_and_run {
    scene  "hall.ttl"
    goal   lab:C1 lies lab:P2 and lab:C2 lies lab:P1 and lab:C1.isEmpty == false
    expect lab:C1 lies lab:P2
    expect lab:T1 lies lab:P2
}

test nothing_is_left_to_do {
    scene  "hall.ttl"
    start  lab:C1 lies lab:P1
    goal   lab:C1 lies lab:P1
    expect lab:C1.isEmpty == false
}
"""
)
SCENE = """@prefix lab: <http://example.org/lab#> .
@prefix l: <https://w3id.org/skillc/library/effects#> .
lab:P1 a l:Place . lab:P2 a l:Place .
lab:T1 a l:Tray ; l:lies lab:P1 .
lab:C1 a l:Cup ; l:lies lab:T1 ; l:isEmpty false ; l:isOpen true .
lab:C2 a l:Cup ; l:lies lab:P1 ; l:isEmpty false ; l:isOpen false .
"""


def test_runs_do_what_is_planned(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "effects"
    folder.mkdir()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    for name, text in (
        ("effects.skill", RUNS),
        ("hall.ttl", SCENE),
        ("skillc.toml", 'name = "effects"\nedition = 2\n'),
    ):
        (folder / name).write_text(text, "utf-8")
    result = CliRunner().invoke(skillc, ["test", str(folder)])
    assert result.exit_code == 0, result.output
    assert result.output.count("passed") >= 3
