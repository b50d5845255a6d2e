"""The times of a plan are those of the body that runs it, in which each step waits for those that it needs."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from plans.depot import SKIROS, Depot, contain, goal, iri, library, world
from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.planning.makespan.minimise import minimise_makespan
from skillc_runtime.planning.plan import Plan, PlanResult, Solved, Step
from skillc_runtime.planning.progress import ReportProgress, ignore_progress
from skillc_runtime.planning.schedule import Planners, Scheduled
from skillc_runtime.world.state.changes import AddIndividual
from skillc_runtime.world.state.model import WorldModel

PRODUCT = SKIROS + "Product"


@dataclass(frozen=True)
class Always:
    """A planner that knows one plan."""

    answer: Plan
    name: str = "somebody"

    def plan(self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
        """Return the plan."""
        return Solved(self.answer, "best found", self.name)


def step(skill: str, **arguments: str) -> Step:
    return Step(skill, {name.rstrip("_"): iri(value) for name, value in arguments.items()})


UNLOAD = step("Unload", robot="dora", crate="box", to="b")
COME = step("Go", robot="carl", to="b", from_="a")
LEAVE = step("Go", robot="dora", to="c", from_="b")
TAKE = step("Load", robot="carl", crate="box", from_="b")
"""Dora leaves once she has unloaded; Carl takes the box once it is there, and he is."""

PLANS = {
    "who leaves does not wait for who comes, only who takes does": (
        (UNLOAD, COME, LEAVE, TAKE),
        "lab:dora at lab:c and lab:carl contain lab:box",
        7.0,
    ),
    "one after the other": ((UNLOAD, LEAVE), "lab:dora at lab:c and lab:b contain lab:box", 7.0),
    "side by side": ((COME, UNLOAD), "lab:carl at lab:b and lab:b contain lab:box", 5.0),
}


@pytest.mark.parametrize("name", PLANS)
def test_a_plan_is_over_when_its_times_say(name: str) -> None:
    steps, text, expected_s = PLANS[name]
    state = world({"carl": "a", "dora": "b"}, {}, "a b c")
    state = state.with_changes([AddIndividual(iri("box"), (PRODUCT,)), contain("dora", "box")])
    aim = goal(text, state)
    plan = Plan(steps, sum(5.0 if each.skill == "Go" else 2.0 for each in steps))
    planners = Planners((Always(plan),), None)
    answer = minimise_makespan(library(), state, aim, planners)
    assert isinstance(answer, Scheduled) and answer.schedule.makespan_s == expected_s, answer
    prepared = prepare_task(Assignment("hand over", state, AchieveGoal(aim, "makespan")), library(), planners=planners)
    assert isinstance(prepared, PreparedTask), prepared
    depot = Depot(WorldModel(state))
    execution = execute_task(prepared, library(), depot, [])  # type: ignore[arg-type]
    assert execution.status == "succeeded", execution.failure
    assert depot.now == pytest.approx(expected_s, abs=0.2), "as long as it was said to take"
