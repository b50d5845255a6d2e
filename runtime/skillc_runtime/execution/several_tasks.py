"""Plans what is to be done in a world, which may be several tasks at once."""

from __future__ import annotations

from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.assignment import AchieveGoal, Assignment
from skillc_runtime.planning.makespan import time_limit
from skillc_runtime.planning.objectives.several import PlanFrom, SeveralTasks, plan_several, refuse_late_tasks
from skillc_runtime.planning.schedule import PlanAnswer


def find_several(assignment: Assignment, library: SkillLibrary) -> SeveralTasks | None:
    """Return the tasks that are planned as one; None if there is only one."""
    goal = assignment.plan_goal(library)
    if not assignment.parts or goal is None:
        return None
    return SeveralTasks(assignment.parts, assignment.plan_library(library), assignment.state, goal)


def plan_at_once(assignment: Assignment, library: SkillLibrary, objective: AchieveGoal, plan: PlanFrom) -> PlanAnswer:
    """Return a plan for an objective; what makes plans gets the goals of several tasks at once, or in turn."""
    tasks = find_several(assignment, library)
    if tasks is None:
        return plan(assignment.state, objective.goal)
    return plan_several(tasks, plan, objective.minimise == "makespan")


def refuse_late(assignment: Assignment, answer: PlanAnswer, library: SkillLibrary) -> PlanAnswer:
    """Return an answer, or that there is no plan if the task, or one of several, would be done too late."""
    known = assignment.plan_library(library)
    kept = time_limit.refuse_late(answer, assignment.within_s, known, assignment.state)
    tasks = find_several(assignment, library)
    return kept if tasks is None else refuse_late_tasks(kept, tasks)
