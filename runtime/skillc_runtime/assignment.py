"""What is to be done in a world, and everything that happens to it before anything moves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import assert_never

from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.skills import SkillLibrary
from skillc_compiler.library.tree import Node
from skillc_runtime.planning.plan import Solved, Step
from skillc_runtime.planning.problem import GoalError
from skillc_runtime.planning.solve import solve
from skillc_runtime.plans.body import plan_body
from skillc_runtime.plans.order import arranged, numbers
from skillc_runtime.selection.preflight import preflight
from skillc_runtime.world.state import WorldState


@dataclass(frozen=True, slots=True)
class Reach:
    """A goal to plan for."""

    goal: Condition


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


def prepare(assignment: Assignment, library: SkillLibrary, without: Sequence[Step] = ()) -> Prepared | Refused:
    """Plan if there is a goal, and look for everything that would keep the body from running, before anything moves.

    `without` are steps that the plan may not have.
    """
    match assignment.aim:
        case Reach(goal):
            prepared = _planned(assignment, goal, library, without)
        case Perform(body):
            prepared = Prepared(assignment, body, None)
        case _:
            assert_never(assignment.aim)
    if isinstance(prepared, Refused):
        return prepared
    refusals = preflight(prepared.body, library, assignment.state)
    return Refused("\n".join(map(str, refusals))) if refusals else prepared


def _planned(
    assignment: Assignment, goal: Condition, library: SkillLibrary, without: Sequence[Step]
) -> Prepared | Refused:
    try:
        answer = solve(library, assignment.state, goal, without=without)
    except GoalError as error:
        return Refused(str(error))
    if not isinstance(answer, Solved):
        return Refused(answer.why)
    arrangement = arranged(answer.plan, library, assignment.state)
    steps = tuple(answer.plan.steps[number] for number in numbers(arrangement))
    return Prepared(assignment, plan_body(answer.plan, arrangement, library), Planned(answer, steps))
