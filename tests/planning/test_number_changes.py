"""Numbers that skills change: the planners, the world model and a plain search agree in random worlds."""

from __future__ import annotations

from collections.abc import Iterator
from heapq import heappop, heappush
from itertools import count, product
from typing import NamedTuple

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.pipeline import compile as compile_sources
from skillc_dsl.source import Source
from skillc_model.always import keep_always
from skillc_model.conditions import And, Compare, Condition, Forall, Holds, Individual, Literal, PropertyOf, Variable
from skillc_model.pddl.formulas import Conjunction, Universal, conjuncts
from skillc_model.pddl.preparing.cases import count_cases
from skillc_model.pddl.preparing.complement import add_complements
from skillc_model.pddl.preparing.single_values import deny_other_values
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.arrangement import InParallel, InSeries, arrange_plan
from skillc_runtime.planning.plan import GaveUp, Plan, Solved, Step, Unsolvable
from skillc_runtime.planning.problem import levels
from skillc_runtime.planning.problem.levels import level_problem
from skillc_runtime.planning.problem.pose import pose_problem
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import PlanError, apply_step, follow_plan
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.world_state import WorldState

TEXT = """use sumo
class Place < Object
class Dock < Place
class Robot < Object  disjoint Place
relation stands(Robot, Place)  functional
property charge(Robot): Number  range 0 .. 1
property trips(Robot): Int  range 0 .. 3
property wear(Robot): Number
property way(Place): Number

## Drive: the farther, the more it costs.
skill Drive {
    in    robot: Robot
    in    to:    Place
    infer from:  Place
    pre   robot stands from
    pre   not to == from
    pre   robot.charge >= 0.2
    post  robot stands to
    post  robot.charge -= 0.1 + to.way
    post  robot.trips += 1
    duration 2 s
}

skill Charge {
    in    robot: Robot
    infer dock:  Dock
    pre   robot stands dock
    post  robot.charge := 1
    duration 5 s
}

## Take some of the charge of another robot in the same place.
skill Share {
    in    robot: Robot
    in    other: Robot
    infer place: Place
    pre   robot stands place and other stands place and not robot == other
    pre   other.charge > robot.charge
    post  robot.charge += 0.3
    post  robot.wear += 1
    post  other.charge -= 0.3
    duration 1 s
}

impl plain of Drive { run python "skillc.primitives:StandIn" }
impl plain of Charge { run python "skillc.primitives:StandIn" }
impl plain of Share { run python "skillc.primitives:StandIn" }
"""
LAB = "http://example.org/lab#"
OWN = "https://w3id.org/skillc/library/charging#"


COMPILED = compile_sources([Source("own.skill", TEXT)], load_vocabulary(), {}, "charging", {})
LIBRARY = COMPILED.value


class World(NamedTuple):
    """Where two robots stand, how full they are, and how far the places are away."""

    stands: tuple[str, str]
    charge: tuple[float | None, float | None]
    way: tuple[float | None, ...]


PLACES = ("dock", "hall", "yard")
WORLDS = st.builds(
    World,
    st.tuples(*[st.sampled_from(PLACES)] * 2),
    st.tuples(*[st.sampled_from([None, 0.0, 0.1, 0.3, 0.7, 1.0])] * 2),
    st.tuples(*[st.sampled_from([None, 0.0, 0.1, 0.2])] * 3),
)


def make(world: World) -> WorldState:
    def facts() -> Iterator[Change]:
        for place, way in zip(PLACES, world.way, strict=True):
            yield AddIndividual(LAB + place, (OWN + ("Dock" if place == "dock" else "Place"),))
            if way is not None:
                yield SetProperty(LAB + place, OWN + "way", way)
        for robot, place, charge in zip("rs", world.stands, world.charge, strict=True):
            yield AddIndividual(LAB + robot, (OWN + "Robot",))
            yield AddRelation(LAB + robot, OWN + "stands", LAB + place)
            yield SetProperty(LAB + robot, OWN + "trips", 0)
            yield SetProperty(LAB + robot, OWN + "wear", 0.0)
            if charge is not None:
                yield SetProperty(LAB + robot, OWN + "charge", charge)

    return WorldState.empty(LIBRARY.vocabulary).with_changes(facts())


def stands(robot: str, place: str) -> Condition:
    return Holds(Individual(LAB + robot), OWN + "stands", Individual(LAB + place))


def number(robot: str, property_: str, operator: str, value: float) -> Condition:
    return Compare(PropertyOf(Individual(LAB + robot), OWN + property_), operator, Literal(value))  # type: ignore[arg-type]


GOALS = st.sampled_from(
    [
        And((stands("r", "hall"), number("r", "charge", ">=", 0.5))),
        And((stands("r", "yard"), stands("s", "hall"))),
        number("s", "charge", "==", 0.4),
        And((number("r", "trips", "==", 2), stands("r", "dock"))),
        And((number("r", "charge", "<", 0.2), number("s", "charge", ">=", 0.9))),
    ]
)


def steps() -> Iterator[tuple[Step, float]]:
    robots, places = [LAB + each for each in "rs"], [LAB + each for each in PLACES]
    for robot, to, from_ in product(robots, places, places):
        yield Step("Drive", {"robot": robot, "to": to, "from": from_}), 2.0
    for robot in robots:
        yield Step("Charge", {"robot": robot, "dock": LAB + "dock"}), 5.0
    for robot, other, place in product(robots, robots, places):
        yield Step("Share", {"robot": robot, "other": other, "place": place}), 1.0


MOST_S = 14.0


def search(start: WorldState, goal: Condition) -> float | None:
    """Return the least duration of a plan by trying all; None if none takes up to MOST_S."""

    def key(state: WorldState) -> object:
        read = [(OWN + "charge", 9), (OWN + "trips", 9)]
        numbers = [state.value(LAB + robot, iri) for robot in "rs" for iri, _ in read]
        rounded = tuple(None if each is None else round(float(each), 9) for each in numbers)  # type: ignore[arg-type]
        return rounded, tuple(sorted(state.pairs(OWN + "stands")))

    ways, tie, seen = [(0.0, 0, start)], count(1), set[object]()
    choices = tuple(steps())
    while ways:
        cost, _, state = heappop(ways)
        if key(state) in seen:
            continue
        seen.add(key(state))
        if evaluate(goal, state, {}):
            return cost
        for step, seconds in choices:
            if cost + seconds <= MOST_S:
                try:
                    heappush(ways, (cost + seconds, next(tie), apply_step(step, LIBRARY, state)))
                except PlanError:
                    continue
    return None


@pytest.mark.slow
@settings(max_examples=4, deadline=None)
@given(WORLDS, GOALS)
def test_the_planner_finds_what_a_plain_search_finds(world: World, goal: Condition) -> None:
    state = make(world)
    answer = solve(LIBRARY, state, goal, (AStar(),))
    least = search(state, goal)
    if least is None:
        assert not isinstance(answer, Solved) or answer.plan.duration_s > MOST_S
        return
    assert isinstance(answer, Solved), answer
    assert answer.plan.duration_s == least
    assert answer.optimal == "proven" or answer.left_out
    assert all("." not in name for step in answer.plan.steps for name in step.arguments)
    assert evaluate(goal, follow_plan(answer.plan, LIBRARY, state)[-1], {})


EMPTY = World(("hall", "yard"), (0.3, 0.2), (0.0, 0.1, 0.1))


@pytest.mark.slow
def test_a_plan_charges_first() -> None:
    goal = And((stands("r", "yard"), number("r", "charge", ">=", 0.8)))
    answer = solve(LIBRARY, make(EMPTY), goal, (AStar(),))
    assert isinstance(answer, Solved), answer
    assert [each.skill for each in answer.plan.steps] == ["Drive", "Charge", "Drive"]
    assert answer.optimal == "proven"


def test_what_no_charge_allows_is_proved_to_have_no_plan() -> None:
    answer = solve(LIBRARY, make(EMPTY), number("r", "charge", ">", 1.5), (AStar(),))
    assert isinstance(answer, Unsolvable)


@pytest.mark.slow
def test_nothing_is_proved_where_a_number_may_have_any_value(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(levels, "MOST_LEVELS", 12)
    monkeypatch.setattr(levels, "FEW_LEVELS", 3)
    world = make(World(("hall", "hall"), (0.1, 1.0), (0.0, 0.0, 0.0)))
    few = solve(LIBRARY, world, number("r", "wear", "==", 7), (AStar(),))
    assert isinstance(few, GaveUp)
    assert [each.kind for each in few.needed] == ["numbers"]
    solved = solve(LIBRARY, world, number("r", "wear", "==", 1), (AStar(),))
    assert isinstance(solved, Solved)
    assert solved.optimal == "optimal for the filtered problem"


def test_steps_that_change_the_same_number_do_not_overlap() -> None:
    state = make(World(("hall", "hall"), (0.5, 1.0), (0.0, 0.0, 0.0)))
    share = Step("Share", {"robot": LAB + "r", "other": LAB + "s", "place": LAB + "hall"})
    drive = Step("Drive", {"robot": LAB + "s", "to": LAB + "yard", "from": LAB + "hall"})
    away = Step("Drive", {"robot": LAB + "r", "to": LAB + "dock", "from": LAB + "hall"})
    for pair, kind in (((share, drive), InSeries), ((drive, away), InParallel)):
        assert isinstance(arrange_plan(Plan(pair, 0.0), LIBRARY, state), kind)


@pytest.mark.slow
def test_what_is_so_of_all_is_said_without_a_case_for_each_value() -> None:
    enough = Forall("x", OWN + "Robot", Compare(PropertyOf(Variable("x"), OWN + "charge"), ">=", Literal(0.1)))
    kept, state = keep_always(LIBRARY, (enough,)), make(World(("hall", "dock"), (0.3, 0.3), (0.0, 0.1, 0.0)))
    goal = And((stands("r", "dock"), number("s", "charge", ">=", 0.5), enough))
    levelled = level_problem(kept.library, state, goal)
    before = pose_problem(*levelled[:3]).problem
    after = deny_other_values(before)
    assert isinstance(before.goal, Conjunction) and isinstance(after.goal, Conjunction)
    assert count_cases(before.goal) > count_cases(after.goal) == 1
    plain, said = (AStar().plan(each, CancelToken(60.0)) for each in (before, add_complements(after)))
    assert isinstance(plain, Solved) and plain == said
    drive = add_complements(after).domain.action["drive"].precondition
    assert any(isinstance(each, Universal) and isinstance(each.body, Universal) for each in conjuncts(drive)), drive


def test_the_library_is_free_of_problems() -> None:
    assert COMPILED.diagnostics == ()
