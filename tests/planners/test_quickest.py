"""Schedules that are over early: who finds them, what is known about them, and what happens when a planner is wrong."""

from __future__ import annotations

import threading
from dataclasses import dataclass, replace

import pytest

from planners.test_rehearsal import BOTH, GOOD, WORLD, carry, in_order, step
from plans import depot
from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.pddl.problem import Problem
from skillc_runtime.planning.aries.solver import Aries, installed
from skillc_runtime.planning.astar import AStar
from skillc_runtime.planning.busy import work_of
from skillc_runtime.planning.choose import Planners
from skillc_runtime.planning.critical import critical_path_s
from skillc_runtime.planning.plan import GaveUp, Plan, Planner, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.problem import pose_problem
from skillc_runtime.planning.schedule import Schedule, Scheduled
from skillc_runtime.plans.quickest import ScheduleResult, quickest
from skillc_runtime.plans.rehearsal import rehearse
from skillc_runtime.world.state import WorldState

LIBRARY = depot.library()
TWO_AWAY = depot.world({"carl": "a", "dora": "b"}, {"crate": "a", "box": "a"}, "a b c")
"""One robot would do with 23 seconds of work: load, go, unload, go back, load, go, unload."""
BOTH_AWAY = depot.goal("lab:c contain lab:crate and lab:c contain lab:box", TWO_AWAY)


@dataclass(frozen=True)
class Says:
    """A scheduler that says what it was told to say."""

    answer: Schedule | GaveUp
    name: str = "somebody"

    def schedule(self, problem: Problem, deadline_s: float) -> Schedule | GaveUp:
        """Return the answer."""
        return self.answer


@dataclass(frozen=True)
class Alone:
    """A planner that lets one robot do everything."""

    name: str = "a lazy one"

    def plan(self, problem: Problem, deadline_s: float) -> PlanResult:
        """Return its only plan."""
        back = step("Go", robot="carl", to="a", from_="c")
        steps = (*carry("carl", "crate", "a", "c"), *carry("carl", "box", "a", "c"))
        return Solved(
            Plan((*(each.step for each in steps[:3]), back, *(each.step for each in steps[3:])), 23.0),
            "best found",
            self.name,
        )


def ask(
    answer: Schedule | GaveUp | None,
    world: WorldState = TWO_AWAY,
    goal: Condition = BOTH_AWAY,
    planner: Planner = AStar(),  # noqa: B008  it has no state
) -> ScheduleResult:
    scheduler = None if answer is None else Says(answer)
    return quickest(LIBRARY, world, goal, Planners((planner,), scheduler), 20.0)


GO = replace(carry("dora", "box", "b", "a")[1], start_s=0.0)
QUICK = in_order(*carry("carl", "crate", "a", "c"), GO, *carry("dora", "box", "a", "c", 5.0))


def test_without_a_temporal_planner_the_plan_with_the_least_work_gets_times_and_says_so() -> None:
    answer = ask(None)
    assert isinstance(answer, Scheduled)
    assert (answer.plan.duration_s, answer.optimal, answer.planner) == (23.0, "best found", "built-in A*")
    assert answer.schedule.makespan_s >= 14.0
    assert "as soon as" in answer.times and "skillc[temporal]" in (answer.note or "")
    assert answer.at_least_s is not None and 0.0 < answer.at_least_s <= 14.0


def test_a_better_schedule_is_taken_and_tightened() -> None:
    loose = Schedule(tuple(replace(each, start_s=1.02 * each.start_s) for each in QUICK.steps))
    answer = ask(loose, planner=Alone())
    assert isinstance(answer, Scheduled)
    assert (answer.planner, answer.schedule.makespan_s, answer.plan.duration_s) == ("somebody", 14.0, 23.0)
    assert rehearse(answer.schedule, LIBRARY, TWO_AWAY, BOTH_AWAY)
    assert answer.as_solved().plan.duration_s == 14.0


def test_a_wrong_schedule_is_rejected_and_reported() -> None:
    wrong = (GaveUp("its time was up"), GOOD, Schedule(()), Schedule(QUICK.steps[:-1]))
    for each in wrong:
        answer = ask(each)
        assert isinstance(answer, Scheduled) and answer.planner == "built-in A*"
        why = "its time was up" if isinstance(each, GaveUp) else "somebody returned a schedule that does not work"
        assert why in (answer.note or "")
    assert len(wrong) == 4


def test_what_has_no_plan_has_no_schedule() -> None:
    assert isinstance(
        ask(QUICK, depot.world({}, {"crate": "a"}), depot.goal("lab:c contain lab:crate", TWO_AWAY)), Unsolvable
    )


def test_a_schedule_that_meets_a_bound_is_proved() -> None:
    world = depot.world({"carl": "a"}, {"crate": "a"}, "a b")
    answer = ask(GaveUp("it is not even asked"), world, depot.goal("lab:b contain lab:crate", world))
    assert isinstance(answer, Scheduled) and answer.optimal == "proven" and answer.note is None
    assert answer.schedule.makespan_s == 9.0


def test_bounds_hold() -> None:
    problem = pose_problem(LIBRARY, WORLD, BOTH).problem
    assert 0.0 < critical_path_s(problem) <= GOOD.makespan_s
    names = {iri: name for name, iri in problem.names.items()}
    for robot in ("carl", "dora"):
        least = AStar().plan(work_of(problem, names[depot.iri(robot)]), 20.0)
        assert isinstance(least, Solved) and least.plan.duration_s == 0.0, "the other one can do everything"
    alone = depot.world({"carl": "a"}, {"crate": "a", "box": "b"}, "a b c")
    problem = pose_problem(LIBRARY, alone, BOTH).problem
    names = {iri: name for name, iri in problem.names.items()}
    least = AStar().plan(work_of(problem, names[depot.iri("carl")]), 20.0)
    cheapest = AStar().plan(problem, 20.0)
    assert isinstance(least, Solved) and isinstance(cheapest, Solved)
    assert least.plan.duration_s == cheapest.plan.duration_s > 0.0


PROGRAM = installed()
needs_aries = pytest.mark.skipif(PROGRAM is None, reason="aries is an extra")


@needs_aries
def test_aries_finds_what_two_robots_can_do_at_once() -> None:
    assert PROGRAM is not None
    answer = Aries(PROGRAM).schedule(pose_problem(LIBRARY, WORLD, BOTH).problem, 20.0)
    assert isinstance(answer, Schedule), answer
    assert rehearse(answer, LIBRARY, WORLD, BOTH)
    assert answer.makespan_s == pytest.approx(9.0, abs=0.1)


@needs_aries
@pytest.mark.parametrize(
    "text", ["lab:a contain lab:crate or lab:c contain lab:crate", "exists p: Location (p contain lab:crate)"]
)
def test_aries_takes_goals_of_every_kind(text: str) -> None:
    assert PROGRAM is not None
    world = depot.world({"carl": "a"}, {"crate": "a"}, "a b c").changed(())
    goal = depot.goal(f"({text}) and lab:carl at lab:b", world)
    answer = Aries(PROGRAM).schedule(pose_problem(LIBRARY, world, goal).problem, 20.0)
    assert isinstance(answer, Schedule), answer
    assert [each.step for each in answer.steps] == [step("Go", robot="carl", to="b", from_="a")]


@needs_aries
def test_several_may_ask_at_the_same_time() -> None:
    assert PROGRAM is not None
    problem, found = pose_problem(LIBRARY, WORLD, BOTH).problem, []

    def plan() -> None:
        found.append(Aries(PROGRAM or "").schedule(problem, 30.0))

    threads = [threading.Thread(target=plan) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [round(each.makespan_s, 1) for each in found if isinstance(each, Schedule)] == [9.0] * 3
