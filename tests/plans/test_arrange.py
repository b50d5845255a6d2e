"""Steps keep the order they need: every arrangement respects it, and every sequence of it leaves the same world."""

from __future__ import annotations

from itertools import pairwise, zip_longest
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from plans.depot import goal, iri, library, world
from skillc_runtime.planning.arrangement import (
    Arrangement,
    InParallel,
    InSeries,
    arrange_partial_order,
    arrange_plan,
    step_numbers,
)
from skillc_runtime.planning.makespan.scheduling import keep_apart, schedule_plan
from skillc_runtime.planning.plan import Plan, Solved, Step
from skillc_runtime.planning.schedule import Scheduled
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import validate
from skillc_runtime.world.state.world_state import WorldState

PAIRS = st.integers(2, 9).flatmap(
    lambda count: st.tuples(st.just(count), st.sets(st.sampled_from([(a, b) for b in range(count) for a in range(b)])))
)


def in_order(arrangement: Arrangement) -> set[tuple[int, int]]:
    """Return the pairs of which an arrangement keeps the order."""
    if isinstance(arrangement, int):
        return set()
    within = set().union(*(in_order(part) for part in arrangement.parts)) if arrangement.parts else set()
    parts = [step_numbers(part) for part in arrangement.parts]
    if isinstance(arrangement, InParallel):
        waiting = [(parts[early], parts[late]) for late, early in _waits(arrangement)]
        return closed(within | {(a, b) for one, other in waiting for a in one for b in other})
    return within | {(a, b) for i, one in enumerate(parts) for other in parts[i + 1 :] for a in one for b in other}


def _waits(arrangement: InParallel) -> list[tuple[int, int]]:
    return [(late, early) for late, each in enumerate(arrangement.after) for early in each]


def closed(pairs: set[tuple[int, int]]) -> set[tuple[int, int]]:
    while more := {(a, d) for a, b in pairs for c, d in pairs if b == c} - pairs:
        pairs = pairs | more
    return pairs


@given(PAIRS)
def test_an_arrangement_has_every_step_once_and_keeps_the_order(drawn: tuple[int, set[tuple[int, int]]]) -> None:
    count, pairs = drawn[0], closed(drawn[1])
    found = arrange_partial_order(range(count), lambda one, other: (one, other) in pairs)
    assert sorted(step_numbers(found)) == list(range(count))
    assert in_order(found) == pairs


def test_series_and_parallel_parts_are_found_exactly() -> None:
    chains = {(0, 1), (2, 3), (3, 4), (2, 4)}
    assert arrange_partial_order(range(5), lambda a, b: (a, b) in chains) == InParallel(
        (InSeries((0, 1)), InSeries((2, 3, 4)))
    )
    diamond = closed({(0, 1), (0, 2), (1, 3), (2, 3)})
    assert arrange_partial_order(range(4), lambda a, b: (a, b) in diamond) == InSeries((0, InParallel((1, 2)), 3))
    assert arrange_partial_order((), lambda a, b: False) == InSeries(())
    crossed = closed({(0, 2), (0, 3), (1, 3), (3, 4)})
    assert arrange_partial_order(range(5), lambda a, b: (a, b) in crossed) == InParallel(
        (0, 1, 2, 3, 4), ((), (), (0,), (0, 1), (3,))
    )


def a_sequence(arrangement: Arrangement, random: Random) -> list[int]:
    """Return one of the sequences that an arrangement allows."""
    if isinstance(arrangement, int):
        return [arrangement]
    parts = [a_sequence(part, random) for part in arrangement.parts]
    if isinstance(arrangement, InSeries):
        return [number for part in parts for number in part]
    merged: list[int] = []
    while any(parts):
        ended = {index for index, part in enumerate(parts) if not part}
        ready = [part for part, after in zip_longest(parts, arrangement.after, fillvalue=()) if ended.issuperset(after)]
        merged.append(random.choice([part for part in ready if part]).pop(0))
    return merged


def side_by_side() -> tuple[Plan, WorldState]:
    """Two robots, each of which loads and unloads a crate, and the world in which they can."""
    state = world({"carl": "a", "dora": "b"}, {"crate": "a", "box": "b"})
    steps = [
        Step(skill, {"robot": iri(robot), "crate": iri(crate), key: iri(place)})
        for robot, crate, place in (("carl", "crate", "a"), ("dora", "box", "b"))
        for skill, key in (("Load", "from"), ("Unload", "to"))
    ]
    return Plan(tuple(steps), 8.0), state


def test_steps_that_a_plan_keeps_apart_are_in_series() -> None:
    plan, state = side_by_side()
    assert in_order(arrange_plan(plan, library(), state)) == {(0, 1), (2, 3)}
    apart = replace(plan, apart=frozenset({(1, 2)}))
    assert in_order(arrange_plan(apart, library(), state)) >= {(0, 1), (1, 2), (2, 3), (0, 3)}


def test_what_is_left_of_a_plan_is_kept_apart_as_before() -> None:
    plan, _ = side_by_side()
    plan = replace(plan, apart=frozenset({(0, 2), (1, 2), (1, 3)}))
    first, second, third, fourth = plan.steps
    assert plan.keep(plan.steps) == plan
    assert plan.keep((second, third, fourth)).apart == {(0, 1), (0, 2)}
    assert plan.keep((third, first)).apart == {(0, 1)}
    assert plan.keep((first, fourth)).apart == frozenset()


def test_a_schedule_that_gets_longer_by_it_is_not_proved_any_more() -> None:
    plan, state = side_by_side()
    schedule = schedule_plan(plan, library(), state)
    answer = Scheduled(schedule, plan, "proven", "somebody", "they follow")
    assert keep_apart(answer, (), library(), state) is answer
    later = keep_apart(answer, {(1, 2)}, library(), state)
    assert (later.schedule.makespan_s, later.optimal, later.at_least_s) == (8.0, "best found", 4.0)
    assert later.as_solved().plan.apart == {(1, 2)}


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_every_sequence_that_an_arrangement_allows_leaves_the_same_world(seed: int) -> None:
    random = Random(seed)
    robots = {name: random.choice("abcd") for name in ("carl", "dora", "emil")}
    crates = {name: random.choice("abcd") for name in ("crate", "box", "bin")}
    state = world(robots, crates)
    wanted = " and ".join(f"lab:{random.choice('abcd')} contain lab:{name}" for name in crates)
    aim = goal(wanted, state)
    answer = solve(library(), state, aim)
    assert isinstance(answer, Solved), answer
    arrangement = arrange_plan(answer.plan, library(), state)
    first = validate(answer.plan, library(), state, aim)
    for _ in range(20):
        steps = tuple(answer.plan.steps[number] for number in a_sequence(arrangement, random))
        last = validate(Plan(steps, 0.0), library(), state, aim)
        assert all(set(last.facts[iri].pairs()) == set(first.facts[iri].pairs()) for iri in first.facts)
    own = [each.arguments["robot"] for each in answer.plan.steps]
    ordered = in_order(arrangement)
    assert all((i, j) in ordered for i, j in pairwise(range(len(own))) if own[i] == own[j]), (
        "a robot does one at a time"
    )
