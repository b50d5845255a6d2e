"""What no helpful step involves is left out, and neither whether there is a plan nor its least duration changes."""

from __future__ import annotations

import os
from itertools import pairwise

import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st

from planning.samples import library, post, skill
from skillc_model.conditions import And, Anything, Condition, Exists, Forall, Holds, Individual, Not, Or, Same, Variable
from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.plan import Solved, Unsolvable
from skillc_runtime.planning.problem import backward
from skillc_runtime.planning.problem.pose import PosedProblem, pose_problem
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.world.state.world_state import WorldState
from world.lab import VOCABULARY, fact, holds, individual, iri, parameter, requirement

EXAMPLES = int(os.environ.get("SKILLC_NEEDED", "25"))
"""How many random problems are planned for; thousands on occasion."""

ANY = Anything()
X, OBJECT, TO, ROBOT, GRIPPER = map(Variable, ("x", "object", "to", "robot", "gripper"))
ROBOTS = (parameter("robot", "Robot", "in"), parameter("gripper", "Gripper", "in"))
HERE, HELD, MOUNTED = (
    holds("robot", "at", "to"),
    holds("gripper", "contain", "object"),
    holds("robot", "hasA", "gripper"),
)
THERE = holds("to", "contain", "object")
CONDITIONS: dict[str, tuple[Condition, ...]] = {
    "Drive": (
        holds("from", "beside", "to"),
        Not(Holds(TO, iri("contain"), ANY)),
        Forall("x", iri("Product"), Or((Not(Holds(TO, iri("contain"), X)), Holds(ANY, iri("near"), X)))),
        Not(Holds(GRIPPER, iri("contain"), ANY)),
    ),
    "Pick": (
        Not(Holds(GRIPPER, iri("contain"), ANY)),
        Not(Exists("x", iri("Eraser"), Holds(GRIPPER, iri("contain"), X))),
        Exists("x", iri("Product"), And((Holds(TO, iri("contain"), X), Not(Same(X, OBJECT))))),
        Forall("x", iri("Product"), Not(Holds(GRIPPER, iri("contain"), X))),
    ),
    "Place": (
        Not(Holds(TO, iri("contain"), ANY)),
        Exists("x", iri("Product"), Holds(TO, iri("contain"), X)),
        Exists("x", iri("Location"), And((Holds(TO, iri("beside"), X), Not(Holds(X, iri("contain"), ANY))))),
        Not(Exists("x", iri("Robot"), And((Holds(X, iri("at"), TO), Not(Same(X, ROBOT)))))),
    ),
}
"""Further preconditions of the skills."""

chosen = st.fixed_dictionaries({name: st.sets(st.sampled_from(range(4)), max_size=2) for name in CONDITIONS})


def skills(further: dict[str, set[int]], named: bool) -> SkillLibrary:
    """Return skills with further preconditions; whether driving names the former place."""
    more = {
        name: tuple(requirement(f"{name}{n}", CONDITIONS[name][n]) for n in sorted(numbers))
        for name, numbers in further.items()
    }
    leaving = (requirement("here", holds("robot", "at", "from")),) if named else ()
    to, thing = parameter("to", "Location", "in"), parameter("object", "Product", "in")
    return library(
        skill(
            "Drive",
            (*ROBOTS, parameter("from", "Location", "in"), to),
            (*leaving, requirement("own", MOUNTED), *more["Drive"]),
            (post(HERE),),
            5.0,
        ),
        skill(
            "Pick",
            (*ROBOTS, to, thing),
            (requirement("own", MOUNTED), requirement("here", HERE), requirement("there", THERE), *more["Pick"]),
            (post(HELD), post(Not(THERE))),
            2.0,
        ),
        skill(
            "Place",
            (*ROBOTS, to, thing),
            (requirement("own", MOUNTED), requirement("here", HERE), requirement("held", HELD), *more["Place"]),
            (post(THERE), post(Not(HELD))),
            3.0,
        ),
    )


PLACES, PARTS = tuple(f"place-{n}" for n in range(4)), tuple(f"part-{n}" for n in range(4))
BASE = WorldState.empty(VOCABULARY).with_changes(
    [
        *(individual(f"robot-{n}", "Robot") for n in range(2)),
        *(individual(f"gripper-{n}", "Gripper") for n in range(2)),
        *(fact(f"robot-{n}", "hasA", f"gripper-{n}") for n in range(2)),
        *(individual(each, "Location") for each in PLACES),
        *(individual(each, "Eraser" if each == "part-3" else "Product") for each in PARTS),
        *(fact(one, "beside", other) for one, other in pairwise(PLACES)),
    ]
)
holders = st.sampled_from((*PLACES, *PLACES, "gripper-0"))
scenes = st.builds(
    lambda where, robots, extra: BASE.with_changes(
        [
            *(fact(holder, "contain", part) for part, holder in zip(PARTS, where, strict=True)),
            *(fact(f"robot-{n}", "at", place) for n, place in enumerate(robots)),
            *(fact(one, "beside", other) for one, other in extra),
        ]
    ),
    st.lists(holders, min_size=4, max_size=4),
    st.lists(st.sampled_from(PLACES), min_size=1, max_size=2),
    st.lists(st.tuples(st.sampled_from(PLACES), st.sampled_from(PLACES)), max_size=1),
)


def _named(name: str) -> Individual:
    return Individual(iri(name))


held = st.builds(
    lambda place, part: Holds(_named(place), iri("contain"), _named(part)),
    st.sampled_from(PLACES),
    st.sampled_from(PARTS),
)
driven = st.sampled_from(PLACES).map(lambda place: Holds(_named("robot-0"), iri("at"), _named(place)))
goals = st.one_of(held, held, held.map(Not), driven)


@given(scenes, goals, chosen, st.booleans())
@settings(max_examples=EXAMPLES)
def test_the_optimum_is_that_of_the_whole_problem(
    state: WorldState, goal: Condition, further: dict[str, set[int]], named: bool
) -> None:
    known = skills(further, named)
    less = pose_problem(known, state, goal)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(backward, "MAX_STEPS", 0)
        whole = pose_problem(known, state, goal)
    left_out = len(whole.problem.objects) - len(less.problem.objects)
    answer = _least_s(less)
    event(f"{left_out} left out, {'a plan' if answer else 'no plan'}")
    assert answer == _least_s(whole)


def _least_s(posed: PosedProblem) -> float | None:
    answer = AStar().plan(posed.problem, CancelToken(60.0))
    assert isinstance(answer, Solved | Unsolvable), answer
    return answer.plan.duration_s if isinstance(answer, Solved) else None


def test_parts_that_a_goal_does_not_name_do_not_come_in_and_the_roads_stay() -> None:
    count = 300
    crowd = BASE.with_changes(
        [
            *(individual(f"other-{n}", "Product") for n in range(count)),
            *(fact(PLACES[n % 4], "contain", f"other-{n}") for n in range(count)),
            fact("place-0", "contain", "part-0"),
            fact("robot-0", "at", "place-3"),
        ]
    )
    asked = Holds(_named("place-2"), iri("contain"), _named("part-0"))
    result = solve(skills({"Drive": {0}, "Pick": {0}, "Place": set()}, True), crowd, asked, (AStar(),))
    assert isinstance(result, Solved) and result.optimal == "proven"
    assert [step.skill for step in result.plan.steps] == [*["Drive"] * 3, "Pick", *["Drive"] * 2, "Place"]
    assert all(each.harmless for each in result.left_out)
    assert count <= sum(len(each.what) for each in result.left_out)


def test_what_is_in_the_way_is_not_left_out() -> None:
    blocked = BASE.with_changes(
        [
            fact("place-0", "contain", "part-0"),
            fact("place-2", "contain", "part-1"),
            fact("robot-0", "at", "place-0"),
        ]
    )
    asked = Holds(_named("place-2"), iri("contain"), _named("part-0"))
    result = solve(skills({"Drive": {0}, "Pick": {0}, "Place": {0}}, True), blocked, asked, (AStar(),))
    assert isinstance(result, Solved) and result.optimal == "proven"
    assert iri("part-1") in {each for step in result.plan.steps for each in step.arguments.values()}
