"""What is to be done in a world, and everything that happens to it before anything moves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, assert_never

from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.skills import SkillLibrary
from skillc_compiler.library.tree import Node
from skillc_runtime.planning.plan import PlanResult, Solved, Step
from skillc_runtime.planning.planners import Planners, find_planners
from skillc_runtime.planning.schedule import Scheduled
from skillc_runtime.planning.solve import solve
from skillc_runtime.plans.body import plan_body
from skillc_runtime.plans.order import arranged, numbers
from skillc_runtime.plans.quickest import quickest
from skillc_runtime.selection.preflight import preflight
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class Reach:
    """A goal to plan for, and what the plan is to have little of: work of all robots, or time until it is over."""

    goal: Condition
    minimise: Literal["work", "makespan"] = "work"


@dataclass(frozen=True, slots=True)
class Perform:
    """A body to run as it stands."""

    body: Node


@dataclass(frozen=True, slots=True)
class Assignment:
    """What is to be done in a world."""

    name: str
    state: WorldState
    aim: Reach | Perform


@dataclass(frozen=True, slots=True)
class Prepared:
    """An assignment with the body that will run; `planned` is what it runs, None where the body was given."""

    assignment: Assignment
    body: Node
    planned: Planned | None


@dataclass(frozen=True, slots=True)
class Planned:
    """How a body was planned: the planner's answer, and its steps in the order in which they stand in the body."""

    solved: Solved
    steps: tuple[Step, ...]


@dataclass(frozen=True, slots=True)
class Refused:
    """A task that does not start, and why."""

    why: str


def prepare(
    assignment: Assignment, library: SkillLibrary, without: Sequence[Step] = (), planners: Planners | None = None
) -> Prepared | Refused:
    """Plan if there is a goal, and look for everything that would keep the body from running, before anything moves.

    `without` are steps that the plan may not have; unless told, those planners are used that are installed.
    """
    match assignment.aim:
        case Reach():
            prepared = _planned(assignment, assignment.aim, library, without, planners or find_planners())
        case Perform(body):
            prepared = Prepared(assignment, body, None)
        case _:
            assert_never(assignment.aim)
    if isinstance(prepared, Refused):
        return prepared
    refusals = preflight(prepared.body, library, assignment.state)
    return Refused("\n".join(map(str, refusals))) if refusals else prepared


def _planned(
    assignment: Assignment, aim: Reach, library: SkillLibrary, without: Sequence[Step], planners: Planners
) -> Prepared | Refused:
    answer = _answered(assignment, aim, library, without, planners)
    if not isinstance(answer, Solved):
        return Refused(answer.message)
    arrangement = arranged(answer.plan, library, assignment.state)
    steps = tuple(answer.plan.steps[number] for number in numbers(arrangement))
    return Prepared(assignment, plan_body(answer.plan, arrangement, library), Planned(answer, steps))


def _answered(
    assignment: Assignment, aim: Reach, library: SkillLibrary, without: Sequence[Step], planners: Planners
) -> PlanResult:
    match aim.minimise:
        case "work":
            return solve(library, assignment.state, aim.goal, planners.for_work, without=without)
        case "makespan":
            answer = quickest(library, assignment.state, aim.goal, planners, without=without)
            return answer.as_solved() if isinstance(answer, Scheduled) else answer
        case _:
            assert_never(aim.minimise)
