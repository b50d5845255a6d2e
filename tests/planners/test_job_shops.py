"""Job shops: what is proved is the optimum of brute force, and steps wait only for those that they need."""

from __future__ import annotations

from collections import Counter
from functools import cache

import pytest

from planners.job_shops import PUBLISHED, SHOP, JobShop, compile_shop, make_goal, make_world
from planners.test_makespan import COMMAND, needs_cp_sat
from skillc_model.pddl.formulas import Disjunction, conjuncts
from skillc_model.pddl.preparing.prepare import remove_axioms
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.arrangement import find_predecessors
from skillc_runtime.planning.cp_sat.solver import CpSat
from skillc_runtime.planning.fast_downward.solver import FastDownward, find_fast_downward
from skillc_runtime.planning.makespan.minimise import minimise_makespan
from skillc_runtime.planning.makespan.scheduling import schedule_plan
from skillc_runtime.planning.makespan.simulation import simulate_schedule
from skillc_runtime.planning.plan import Plan, Solved, Step
from skillc_runtime.planning.problem.pose import pose_problem
from skillc_runtime.planning.schedule import Planners, Scheduled
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve
from waiting import LONG_S

library = cache(compile_shop)


def step(job: int, operation: int, machine: int) -> Step:
    names = {"operation": f"j{job}o{operation}", "job": f"j{job}", "machine": f"m{machine}"}
    return Step("Work", {name: SHOP + value for name, value in names.items()})


def find_least_makespan(shop: JobShop) -> int:
    """Return the least makespan: of all sequences of operations, each as early as its job and machine allow it."""
    best = [sum(time for job in shop.jobs for _, time in job)]

    def go_on(done: Counter[int], jobs: Counter[int], machines: Counter[int]) -> None:
        now = max(jobs.values(), default=0)
        if now >= best[0]:
            return
        if done.total() == sum(map(len, shop.jobs)):
            best[0] = now
        for number, job in enumerate(shop.jobs):
            if done[number] < len(job):
                machine, time = job[done[number]]
                end = max(jobs[number], machines[machine]) + time
                go_on(done + Counter([number]), jobs | Counter({number: end}), machines | Counter({machine: end}))

    go_on(Counter(), Counter(), Counter())
    return best[0]


def test_brute_force_knows_the_optimum() -> None:
    assert find_least_makespan(JobShop((((0, 3), (1, 2)), ((1, 4), (0, 1))))) == 6
    assert find_least_makespan(JobShop((((0, 3),), ((0, 4),)))) == 7


def schedule(shop: JobShop, seconds: float = LONG_S) -> Scheduled:
    assert COMMAND is not None
    planners = Planners((AStar(),), CpSat(COMMAND))
    answer = minimise_makespan(library(), make_world(shop, library()), make_goal(shop), planners, CancelToken(seconds))
    assert isinstance(answer, Scheduled), answer
    assert simulate_schedule(answer.schedule, library(), make_world(shop, library()), make_goal(shop))
    return answer


@needs_cp_sat
@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_the_optimum_is_found_and_proved(seed: int) -> None:
    shop = JobShop.draw(3, 3, seed)
    answer = schedule(shop)
    assert (answer.optimal, answer.schedule.makespan_s) == ("proven", find_least_makespan(shop))


@needs_cp_sat
@pytest.mark.slow
def test_a_published_optimum_is_found_and_proved() -> None:
    answer = schedule(PUBLISHED["ft06"])
    assert (answer.optimal, answer.schedule.makespan_s, answer.planner) == ("proven", 55.0, "CP-SAT")


@pytest.mark.slow
@pytest.mark.skipif(find_fast_downward() is None, reason="the planner is an extra")
def test_fast_downward_takes_conditions_over_all_operations() -> None:
    programs, shop = find_fast_downward(), PUBLISHED["ft06"]
    assert programs is not None
    world, goal = make_world(shop, library()), make_goal(shop)
    answer = solve(library(), world, goal, (FastDownward(programs),), CancelToken(30.0))
    assert isinstance(answer, Solved), answer
    assert (answer.optimal, len(answer.plan.steps), answer.plan.duration_s) == ("proven", 36, 197.0)


def test_an_action_is_copied_where_its_condition_has_too_many_cases() -> None:
    shop = JobShop.draw(4, 2, 0)
    problem = pose_problem(library(), make_world(shop, library()), make_goal(shop)).problem
    plain = remove_axioms(problem)
    assert len(problem.domain.actions) == 1 and len(plain.domain.actions) == 8, "one for each operation"
    assert all(
        not isinstance(each, Disjunction) for one in plain.domain.actions for each in conjuncts(one.precondition)
    )
    assert isinstance(before := AStar().plan(problem, CancelToken(20.0)), Solved)
    assert isinstance(after := AStar().plan(plain, CancelToken(20.0)), Solved)
    assert (after.plan.duration_s, set(map(repr, after.plan.steps))) == (
        before.plan.duration_s,
        set(map(repr, before.plan.steps)),
    )


def test_operations_wait_only_for_those_of_their_job_and_machine() -> None:
    shop = PUBLISHED["ft06"]
    order = [(job, index) for index in range(6) for job in range(6)]
    plan = Plan(tuple(step(job, index, shop.jobs[job][index][0]) for job, index in order), 197.0)
    before = find_predecessors(plan, library(), make_world(shop, library()))
    needed: list[set[int]] = []
    for late, (job, index) in enumerate(order):
        machine = shop.jobs[job][index][0]
        direct = [n for n, (one, other) in enumerate(order[:late]) if one == job or shop.jobs[one][other][0] == machine]
        needed.append(set(direct).union(*(needed[each] for each in direct)))
    assert [set(each) for each in before] == needed
    assert schedule_plan(plan, library(), make_world(shop, library())).makespan_s < 100.0
