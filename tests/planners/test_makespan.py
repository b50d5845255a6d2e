"""Schedules that are over early: who finds them, what is known about them, and what happens when a planner is wrong."""

from __future__ import annotations

import dataclasses
import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from random import Random

import pytest
from msgspec.structs import replace

from planners.test_schedule_simulation import BOTH, GOOD, WORLD, carry, in_order, step
from planning.samples import LAB, library, post, skill
from plans import depot
from skillc.errors import RequestError
from skillc.services.tasks.loading import LoadedTask, with_measure
from skillc_dsl.position import Position
from skillc_model.conditions import Condition, Holds, Individual
from skillc_model.pddl.problem import Problem
from skillc_model.tree import Sequence
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.planning.cp_sat.solver import CpSat, find_cp_sat
from skillc_runtime.planning.fast_downward import solver as fast_downward
from skillc_runtime.planning.fast_downward.solver import FastDownward
from skillc_runtime.planning.makespan.lower_bound import price_device_work
from skillc_runtime.planning.makespan.minimise import minimise_makespan
from skillc_runtime.planning.makespan.simulation import simulate_schedule
from skillc_runtime.planning.plan import GaveUp, Plan, Planner, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.planners import find_planners
from skillc_runtime.planning.problem.pose import pose_problem
from skillc_runtime.planning.progress import ReportProgress, ignore_progress
from skillc_runtime.planning.schedule import FoundSchedule, PlanAnswer, Planners, Schedule, Scheduled
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.search.h_max import critical_path_s
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import validate
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState
from world.lab import holds, iri, parameter

LIBRARY = depot.library()
TWO_AWAY = depot.world({"carl": "a", "dora": "b"}, {"crate": "a", "box": "a"}, "a b c")
"""One robot would do with 23 seconds of work: load, go, unload, go back, load, go, unload."""
BOTH_AWAY = depot.goal("lab:c contain lab:crate and lab:c contain lab:box", TWO_AWAY)


@dataclass(frozen=True)
class Says:
    """A scheduler that says what it was told to say."""

    answer: Schedule | GaveUp
    name: str = "somebody"
    at_least_s: float = 0.0

    def schedule(
        self,
        problem: Problem,
        first: Schedule | None,
        cancel: CancelToken,
        report: ReportProgress = ignore_progress,
    ) -> FoundSchedule | GaveUp:
        """Return the answer."""
        return self.answer if isinstance(self.answer, GaveUp) else FoundSchedule(self.answer, self.at_least_s)


@dataclass(frozen=True)
class Alone:
    """A planner that lets one robot do everything."""

    name: str = "a lazy one"

    def plan(self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
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
) -> PlanAnswer:
    scheduler = None if answer is None else Says(answer)
    return minimise_makespan(LIBRARY, world, goal, Planners((planner,), scheduler), CancelToken(20.0))


GO = replace(carry("dora", "box", "b", "a")[1], start_s=0.0)
QUICK = in_order(*carry("carl", "crate", "a", "c"), GO, *carry("dora", "box", "a", "c", 5.0))


COMMAND = find_cp_sat()
needs_cp_sat = pytest.mark.skipif(COMMAND is None, reason="CP-SAT is an extra")


def test_without_a_temporal_planner_the_plan_with_the_least_work_gets_times_and_says_so() -> None:
    answer = ask(None)
    assert isinstance(answer, Scheduled)
    assert (answer.plan.duration_s, answer.optimal, answer.planner) == (23.0, "best found", "built-in A*")
    assert answer.schedule.makespan_s >= 14.0
    assert "have ended" in answer.times and "skillc[temporal]" in (answer.note or "")
    assert answer.at_least_s is not None and 0.0 < answer.at_least_s <= 14.0


def test_a_better_schedule_is_taken_and_tightened() -> None:
    loose = Schedule(tuple(replace(each, start_s=1.02 * each.start_s) for each in QUICK.steps))
    answer = ask(loose, planner=Alone())
    assert isinstance(answer, Scheduled)
    assert (answer.planner, answer.schedule.makespan_s, answer.plan.duration_s) == ("somebody", 14.0, 23.0)
    assert simulate_schedule(answer.schedule, LIBRARY, TWO_AWAY, BOTH_AWAY)
    assert answer.as_solved().plan.duration_s == 14.0


def test_a_wrong_schedule_is_rejected_and_reported() -> None:
    wrong = (GaveUp("it ran out of time"), GOOD, Schedule(()), Schedule(QUICK.steps[:-1]))
    for each in wrong:
        answer = ask(each)
        assert isinstance(answer, Scheduled) and answer.planner == "built-in A*"
        why = "it ran out of time" if isinstance(each, GaveUp) else "somebody returned a schedule that does not work"
        assert why in (answer.note or "")
    assert len(wrong) == 4


@needs_cp_sat
@pytest.mark.slow
def test_what_effects_replace_need_not_be_named() -> None:
    jump = skill(
        "Jump", (parameter("robot", "Robot"), parameter("to", "Location")), (), (post(holds("robot", "at", "to")),), 1.0
    )
    goal = Holds(Individual(iri("robot")), iri("at"), Individual(iri("wall")))
    problem = pose_problem(library(jump), LAB, goal).problem
    assert isinstance(AStar().plan(problem, CancelToken(20.0)), Solved)
    assert COMMAND is not None
    found = CpSat(COMMAND).schedule(problem, None, CancelToken(20.0))
    assert isinstance(found, FoundSchedule) and [each.step.skill for each in found.schedule.steps] == ["Jump"]


def test_conditional_effects_are_refused_with_a_hint_at_other_planners() -> None:
    problem = pose_problem(LIBRARY, WORLD, BOTH).problem
    go = next(each for each in problem.domain.actions if each.skill == "Go")
    depends = replace(go, effects=tuple(replace(each, condition=go.precondition) for each in go.effects))
    domain = dataclasses.replace(problem.domain, actions=(depends,))
    refused = CpSat(("never started",)).schedule(replace(problem, domain=domain), None, CancelToken(20.0))
    assert isinstance(refused, GaveUp)
    assert "Go changes depends on the state" in refused.why and "--minimise work do" in refused.why


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
    assert 0.0 < critical_path_s(problem, CancelToken(20.0)) <= GOOD.makespan_s
    assert critical_path_s(problem, CancelToken(0.0)) == 0.0, "there was no time to look"
    names = {iri: name for name, iri in problem.names.items()}
    for robot in ("carl", "dora"):
        least = AStar().plan(price_device_work(problem, names[depot.iri(robot)]), CancelToken(20.0))
        assert isinstance(least, Solved) and least.plan.duration_s == 0.0, "the other one can do everything"
    alone = depot.world({"carl": "a"}, {"crate": "a", "box": "b"}, "a b c")
    problem = pose_problem(LIBRARY, alone, BOTH).problem
    names = {iri: name for name, iri in problem.names.items()}
    least = AStar().plan(price_device_work(problem, names[depot.iri("carl")]), CancelToken(20.0))
    cheapest = AStar().plan(problem, CancelToken(20.0))
    assert isinstance(least, Solved) and isinstance(cheapest, Solved)
    assert least.plan.duration_s == cheapest.plan.duration_s > 0.0


def search(world: WorldState, goal: Condition) -> Schedule:
    """Return what CP-SAT finds by itself."""
    assert COMMAND is not None
    answer = CpSat(COMMAND).schedule(pose_problem(LIBRARY, world, goal).problem, None, CancelToken(20.0))
    assert isinstance(answer, FoundSchedule), answer
    assert answer.at_least_s <= answer.schedule.makespan_s
    return answer.schedule


@needs_cp_sat
@pytest.mark.slow
def test_cp_sat_finds_what_two_robots_can_do_at_once() -> None:
    answer = search(WORLD, BOTH)
    assert simulate_schedule(answer, LIBRARY, WORLD, BOTH)
    assert answer.makespan_s == 9.0


@needs_cp_sat
@pytest.mark.slow
@pytest.mark.parametrize(
    "text", ["lab:a contain lab:crate or lab:c contain lab:crate", "exists p: Location (p contain lab:crate)"]
)
def test_cp_sat_takes_goals_of_every_kind(text: str) -> None:
    world = depot.world({"carl": "a"}, {"crate": "a"}, "a b c").with_changes(())
    goal = depot.goal(f"({text}) and lab:carl at lab:b", world)
    assert [each.step for each in search(world, goal).steps] == [step("Go", robot="carl", to="b", from_="a")]


@needs_cp_sat
@pytest.mark.slow
@pytest.mark.skipif(fast_downward.find_fast_downward() is None, reason="the planner is an extra")
def test_several_may_ask_at_the_same_time() -> None:
    programs = fast_downward.find_fast_downward()
    assert programs is not None and COMMAND is not None
    problem, scheduler, planner = pose_problem(LIBRARY, WORLD, BOTH).problem, CpSat(COMMAND), FastDownward(programs)
    with ThreadPoolExecutor(3) as pool:
        plans = [pool.submit(planner.plan, problem, CancelToken(30.0)) for _ in range(2)]
        found = pool.submit(scheduler.schedule, problem, None, CancelToken(30.0)).result()
    assert isinstance(found, FoundSchedule) and simulate_schedule(found.schedule, LIBRARY, WORLD, BOTH)
    first, second = (each.result() for each in plans)
    assert isinstance(first, Solved) and first == second


@needs_cp_sat
@pytest.mark.slow
@pytest.mark.parametrize("seed", range(1, 1 + int(os.environ.get("SKILLC_SCHEDULES", "1"))))
def test_no_schedule_is_worse_than_the_cheapest_plan_or_better_than_the_bounds(seed: int) -> None:
    random = Random(seed)
    robots = {name: random.choice("abcd") for name in ("carl", "dora", "emil")[: random.randint(1, 3)]}
    crates = {name: random.choice("abcd") for name in ("crate", "box")}
    world = depot.world(robots, crates)
    goal = depot.goal(" and ".join(f"lab:{random.choice('abcd')} contain lab:{name}" for name in crates), world)
    answer = minimise_makespan(LIBRARY, world, goal, find_planners(), CancelToken(20.0))
    cheapest = solve(LIBRARY, world, goal)
    assert isinstance(answer, Scheduled) and isinstance(cheapest, Solved)
    assert simulate_schedule(answer.schedule, LIBRARY, world, goal) and validate(answer.plan, LIBRARY, world, goal)
    assert "does not work" not in (answer.note or "") and "no plan" not in (answer.note or "")
    assert answer.schedule.makespan_s <= cheapest.plan.duration_s <= answer.plan.duration_s
    assert answer.schedule.makespan_s >= critical_path_s(pose_problem(LIBRARY, world, goal).problem, CancelToken(20.0))
    assert (answer.schedule.makespan_s == cheapest.plan.duration_s) or len(robots) > 1


def test_what_is_to_be_over_early_is_run_like_that() -> None:
    assignment = Assignment("carry", TWO_AWAY, AchieveGoal(BOTH_AWAY, "makespan"))
    prepared = prepare_task(assignment, LIBRARY, planners=Planners((Alone(),), Says(QUICK)))
    assert isinstance(prepared, PreparedTask) and prepared.planned is not None
    assert prepared.planned.solved.plan.duration_s == 14.0
    assert {each.arguments["robot"] for each in prepared.planned.steps} == {depot.iri("carl"), depot.iri("dora")}


def test_what_is_not_planned_cannot_be_over_early() -> None:
    nothing = Sequence(children=(), reactive=False, source=Position(path="x.skill", line=1, column=1))
    loaded = LoadedTask(LIBRARY, Assignment("carry", TWO_AWAY, ExecuteBody(nothing)), WorldModel(TWO_AWAY))
    with pytest.raises(RequestError, match="there is no plan to minimise"):
        with_measure(loaded, "makespan")
