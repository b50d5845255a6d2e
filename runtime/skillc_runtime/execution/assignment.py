"""What is to be done in a world, and everything that is checked and planned before anything moves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, assert_never

from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_model.tree import Node
from skillc_runtime.execution.plans.plan_body import build_plan_body
from skillc_runtime.execution.selection.preflight import preflight
from skillc_runtime.planning.arrangement import arrange_plan, step_numbers
from skillc_runtime.planning.makespan.minimise import minimise_makespan
from skillc_runtime.planning.plan import PlanResult, Solved, Step
from skillc_runtime.planning.planners import Planners, find_planners
from skillc_runtime.planning.schedule import Scheduled
from skillc_runtime.planning.solve import solve
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class AchieveGoal:
    """A goal to plan for, and what the plan minimises: the work of all robots, or the time until it ends."""

    goal: Condition
    minimise: Literal["work", "makespan"] = "work"


@dataclass(frozen=True, slots=True)
class ExecuteBody:
    """A body to run as it is."""

    body: Node


@dataclass(frozen=True, slots=True)
class Assignment:
    """What is to be done in a world."""

    name: str
    state: WorldState
    objective: AchieveGoal | ExecuteBody


@dataclass(frozen=True, slots=True)
class PlannedSteps:
    """The planner's answer, and the steps of the plan in the order of the body."""

    solved: Solved
    steps: tuple[Step, ...]


@dataclass(frozen=True, slots=True)
class PreparedTask:
    """An assignment with the body that will run; `planned` is None if the body was given."""

    assignment: Assignment
    body: Node
    planned: PlannedSteps | None


@dataclass(frozen=True, slots=True)
class NotStarted:
    """A task that does not start, and the reason."""

    reason: str


def prepare_task(
    assignment: Assignment, library: SkillLibrary, without: Sequence[Step] = (), planners: Planners | None = None
) -> PreparedTask | NotStarted:
    """Plan if there is a goal, and check everything that would keep the body from running, before anything moves.

    The plan has none of the steps in `without`. `planners` defaults to those that are installed.
    """
    match assignment.objective:
        case AchieveGoal() as objective:
            prepared = _prepare_plan(assignment, objective, library, without, planners or find_planners())
        case ExecuteBody(body):
            prepared = PreparedTask(assignment, body, None)
        case _:
            assert_never(assignment.objective)
    if isinstance(prepared, NotStarted):
        return prepared
    refusals = preflight(prepared.body, library, assignment.state)
    return NotStarted("\n".join(map(str, refusals))) if refusals else prepared


def _prepare_plan(
    assignment: Assignment, objective: AchieveGoal, library: SkillLibrary, without: Sequence[Step], planners: Planners
) -> PreparedTask | NotStarted:
    result = _plan(assignment.state, objective, library, without, planners)
    if not isinstance(result, Solved):
        return NotStarted(result.message)
    arrangement = arrange_plan(result.plan, library, assignment.state)
    steps = tuple(result.plan.steps[number] for number in step_numbers(arrangement))
    return PreparedTask(assignment, build_plan_body(result.plan, arrangement, library), PlannedSteps(result, steps))


def _plan(
    state: WorldState, objective: AchieveGoal, library: SkillLibrary, without: Sequence[Step], planners: Planners
) -> PlanResult:
    match objective.minimise:
        case "work":
            return solve(library, state, objective.goal, planners.for_work, without=without)
        case "makespan":
            result = minimise_makespan(library, state, objective.goal, planners, without=without)
            return result.as_solved() if isinstance(result, Scheduled) else result
        case _:
            assert_never(objective.minimise)
