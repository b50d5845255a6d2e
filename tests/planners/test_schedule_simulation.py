"""Schedules are played in the world model: good ones pass, whatever is changed about them is found out."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import cache
from pathlib import Path
from random import Random

import pytest
from msgspec.structs import replace

from plans import depot
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.makespan.scheduling import schedule_plan
from skillc_runtime.planning.makespan.simulation import simulate_schedule
from skillc_runtime.planning.plan import Plan, Solved, Step
from skillc_runtime.planning.schedule import Schedule, TimedStep
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import PlanError
from skillc_runtime.world.state.world_state import WorldState

WORLD = depot.world({"carl": "a", "dora": "b"}, {"crate": "a", "box": "b"}, "a b c")
BOTH = depot.goal("lab:c contain lab:crate and lab:a contain lab:box", WORLD)


def step(skill: str, **arguments: str) -> Step:
    return Step(skill, {name.rstrip("_"): depot.iri(value) for name, value in arguments.items()})


def carry(robot: str, crate: str, from_: str, to: str, start_s: float = 0.0) -> tuple[TimedStep, ...]:
    """Load, go and unload: nine seconds."""
    return (
        TimedStep(step("Load", robot=robot, crate=crate, from_=from_), start_s, 2.0),
        TimedStep(step("Go", robot=robot, to=to, from_=from_), start_s + 2.0, 5.0),
        TimedStep(step("Unload", robot=robot, crate=crate, to=to), start_s + 7.0, 2.0),
    )


def in_order(*steps: TimedStep) -> Schedule:
    return Schedule(tuple(sorted(steps, key=lambda each: each.start_s)))


GOOD = in_order(*carry("carl", "crate", "a", "c"), *carry("dora", "box", "b", "a"))


def test_two_robots_side_by_side_pass() -> None:
    assert simulate_schedule(GOOD, depot.library(), WORLD, BOTH)
    assert GOOD.makespan_s == 9.0
    plan = Plan(tuple(each.step for each in GOOD.steps), 18.0)
    assert sorted(schedule_plan(plan, depot.library(), WORLD).steps, key=repr) == sorted(GOOD.steps, key=repr)


def changed(number: int, change: Callable[[TimedStep], TimedStep]) -> Schedule:
    steps = list(GOOD.steps)
    steps[number] = change(steps[number])
    return in_order(*steps)


WRONG = {
    "begins before the plan": (changed(0, lambda each: replace(each, start_s=-1.0)), "before the plan does"),
    "too short": (changed(0, lambda each: replace(each, duration_s=1.0)), "it takes 2 s, not 1"),
    "too early": (changed(2, lambda each: replace(each, start_s=1.0)), "both lock"),
    "a step is missing": (Schedule(GOOD.steps[:-1]), "the goal does not hold"),
    "nothing": (Schedule(()), "the goal does not hold"),
    "no such skill": (changed(0, lambda each: replace(each, step=step("Fly", robot="carl"))), "no such skill"),
    "somebody else's crate": (
        in_order(*carry("carl", "crate", "a", "c"), *carry("dora", "crate", "b", "a")),
        "does not hold",
    ),
    "one crate taken twice": (
        in_order(TimedStep(step("Load", robot="carl", crate="crate", from_="a"), 0.0, 2.0),
                 TimedStep(step("Load", robot="emil", crate="crate", from_="a"), 1.0, 2.0)),
        "both settle the same facts",
    ),
    "unloaded before it is there": (changed(5, lambda each: replace(each, start_s=6.0)), "`robot at to` does not hold"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_planted_mistakes_are_found(name: str) -> None:
    schedule, why = WRONG[name]
    world = depot.world({"carl": "a", "dora": "b", "emil": "a"}, {"crate": "a", "box": "b"}, "a b c")
    with pytest.raises(PlanError, match=why):
        simulate_schedule(schedule, depot.library(), world, BOTH)


@cache
def shop() -> SkillLibrary:
    return compile_valid(find_library(Path(__file__).with_name("shop.skill")))


def shopping(leaves_at_s: float, goal: str = "lab:a contain lab:box") -> tuple[Schedule, WorldState, Condition]:
    """Return a robot that watches for eight seconds and leaves at some time."""
    world = depot.world({"carl": "a"}, {"crate": "b", "box": "b"}, "a b")
    watch = TimedStep(step("Watch", robot="carl", place="a", goods="box"), 0.0, 8.0)
    leave = TimedStep(step("Leave", robot="carl", to="b", from_="a"), leaves_at_s, 5.0)
    return Schedule((watch, leave)), world, depot.goal(goal, world)


def test_what_a_step_holds_on_to_must_hold_until_it_is_over() -> None:
    schedule, world, goal = shopping(8.0)
    assert simulate_schedule(schedule, shop(), world, goal)
    schedule, world, goal = shopping(3.0)
    assert simulate_schedule(schedule, shop(), world, goal), "the robot has left when both are over"
    schedule, world, goal = shopping(2.0)
    with pytest.raises(PlanError, match="step 1, Watch: `robot at place` does not hold"):
        simulate_schedule(schedule, shop(), world, goal)


def test_no_step_begins_while_another_changes_what_it_reads() -> None:
    _, world, goal = shopping(0.0)
    leave = TimedStep(step("Leave", robot="carl", to="b", from_="a"), 0.0, 5.0)
    watch = TimedStep(step("Watch", robot="carl", place="a", goods="box"), 1.0, 8.0)
    with pytest.raises(PlanError, match="starts while step 1, Leave, changes what it reads"):
        simulate_schedule(Schedule((leave, watch)), shop(), world, goal)


@pytest.mark.parametrize("seed", range(int(os.environ.get("SKILLC_SCHEDULES", "3"))))
def test_earliest_times_pass_and_nothing_earlier_does(seed: int) -> None:
    random = Random(seed)
    world = depot.world({name: random.choice("abc") for name in ("carl", "dora")}, {"crate": "a", "box": "b"}, "a b c")
    goal = depot.goal("lab:c contain lab:crate and lab:c contain lab:box", world)
    solved = solve(depot.library(), world, goal, (AStar(),))
    assert isinstance(solved, Solved), solved
    schedule = schedule_plan(solved.plan, depot.library(), world)
    assert simulate_schedule(schedule, depot.library(), world, goal)
    later = [number for number, each in enumerate(schedule.steps) if each.start_s > 0.0]
    assert later
    for number in later:
        steps = list(schedule.steps)
        steps[number] = replace(steps[number], start_s=steps[number].start_s - 0.5)
        with pytest.raises(PlanError):
            simulate_schedule(in_order(*steps), depot.library(), world, goal)
