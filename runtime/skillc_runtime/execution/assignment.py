"""What is to be done in a world, and what was prepared for it."""

from __future__ import annotations

import msgspec
from msgspec.structs import replace

from skillc_model.conditions import Condition
from skillc_model.skills import PlanMeasure, SkillLibrary, TaskPart
from skillc_model.tree import Node
from skillc_runtime.execution.plans.plan_body import build_plan_body
from skillc_runtime.planning.arrangement import Arrangement, arrange_plan, step_numbers
from skillc_runtime.planning.foresight import foresee
from skillc_runtime.planning.objectives.always import library_that_keeps
from skillc_runtime.planning.plan import Solved, Step
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.world_state import WorldState


class AchieveGoal(msgspec.Struct, frozen=True):
    """A goal to plan for, and what the plan minimises; None if nothing is stated, which is work."""

    goal: Condition
    minimise: PlanMeasure | None = None


class ExecuteBody(msgspec.Struct, frozen=True):
    """A body to run as it is."""

    body: Node


class Sensed(msgspec.Struct, frozen=True):
    """What has come of the last step of a policy, as a clause, and how the policy goes on; None if it does not say."""

    why: str
    branch: Solved | None


class Assignment(msgspec.Struct, frozen=True):
    """What is to be done in a world, after what was `sensed` if it goes on with a policy, within a time in s if any.

    `always` are conditions that neither its plan nor its run may break. Several tasks at once are its `parts`: its goal
    is that of all, and those that come first have precedence.
    """

    name: str
    state: WorldState
    objective: AchieveGoal | ExecuteBody
    sensed: Sensed | None = None
    within_s: float | None = None
    always: tuple[Condition, ...] = ()
    parts: tuple[TaskPart, ...] = ()

    def plan_library(self, library: SkillLibrary) -> SkillLibrary:
        """Return the library with which its plans are made and arranged: they keep what holds always."""
        return library_that_keeps(library, self.always).library

    def plan_goal(self, library: SkillLibrary) -> Condition | None:
        """Return the goal of its plans; None if it has a body."""
        if not isinstance(self.objective, AchieveGoal):
            return None
        return library_that_keeps(library, self.always).goal(self.objective.goal)

    def without_times(self) -> Assignment:
        """Return it without the times that its tasks state, for something else limits it."""
        return replace(self, within_s=None, parts=tuple(replace(each, within_s=None) for each in self.parts))


class PlannedSteps(msgspec.Struct, frozen=True):
    """The planner's answer, how its steps are arranged, and the steps in the order of the body."""

    solved: Solved
    arrangement: Arrangement
    steps: tuple[Step, ...]


class PreparedTask(msgspec.Struct, frozen=True):
    """An assignment with the body that will run; `planned` is None if the body was given.

    `space` is what is known of the plan, or of the body that was given, in space, None if nobody has looked.
    """

    assignment: Assignment
    body: Node
    planned: PlannedSteps | None
    space: SpaceClaim | None = None


class NotStarted(msgspec.Struct, frozen=True):
    """A task that does not start, the reason in a sentence, and what there is to say besides.

    `proved` if no planner finds a plan, whatever time it has.
    """

    reason: str
    detail: str = ""
    proved: bool = False


def arrange_prepared(
    assignment: Assignment, solved: Solved, library: SkillLibrary, space: SpaceClaim | None = None
) -> PreparedTask:
    """Return an assignment with the body of a plan for it; PlanError if the plan does not work.

    `space` is what is known of the plan in space.
    """
    goal, known = assignment.plan_goal(library), assignment.plan_library(library)
    arrangement = arrange_plan(solved.plan, *foresee(known, assignment.state, goal))
    steps = tuple(solved.plan.steps[number] for number in step_numbers(arrangement))
    body = build_plan_body(solved.plan, arrangement, library, space)
    return PreparedTask(assignment, body, PlannedSteps(solved, arrangement, steps), space)
