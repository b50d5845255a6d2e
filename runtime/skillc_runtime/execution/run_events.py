"""Creates the events of a task run: its start, the answers of planners, the plans it follows; and reads answers."""

from __future__ import annotations

from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.assignment import (
    AchieveGoal,
    Assignment,
    ExecuteBody,
    NotStarted,
    PreparedTask,
    arrange_prepared,
)
from skillc_runtime.execution.attempt import CellOrigin
from skillc_runtime.execution.plans.plan_record import (
    record_arrangement,
    record_branches,
    record_plan,
    record_steps,
    restore_plan,
)
from skillc_runtime.execution.tree.gate import Gate, format_breakpoints
from skillc_runtime.planning.plan import describe_quality
from skillc_runtime.recording.events import FORMAT, PlanArrived, PlanMade, TaskStarted
from skillc_runtime.recording.run_spec import RunSpec


def make_start_event(
    assignment: Assignment,
    library: SkillLibrary,
    origin: CellOrigin,
    now: float,
    spec: RunSpec | None = None,
    gate: Gate | None = None,
) -> TaskStarted:
    """Return the event that a task starts at the time `now` of the cell in s."""
    objective, gate = assignment.objective, gate or Gate()
    return TaskStarted(
        time=now,
        format=FORMAT,
        task=assignment.name,
        library=library.name,
        hash=library.hash,
        scene=origin.scene,
        seed=origin.seed,
        backend=origin.backend,
        goal=objective.goal if isinstance(objective, AchieveGoal) else None,
        minimise=(objective.minimise or "work") if isinstance(objective, AchieveGoal) else "",
        body=objective.body if isinstance(objective, ExecuteBody) else None,
        within_s=assignment.within_s,
        always=assignment.always,
        parts=assignment.parts,
        settings=spec or RunSpec(),
        breakpoints=format_breakpoints(gate.breakpoints),
        stepped=gate.stepping,
    )


def make_plan_event(prepared: PreparedTask, library: SkillLibrary, now: float) -> PlanMade | None:
    """Return the event that a plan is followed from `now` on, in s of the cell; None if nothing was planned."""
    if prepared.planned is None:
        return None
    solved = prepared.planned.solved
    return PlanMade(
        time=now,
        planner=solved.planner,
        optimal=solved.optimal,
        cost=solved.plan.duration_s,
        steps=record_steps(solved.plan, library),
        quality=describe_quality(solved.optimal, solved.left_out, solved.at_least_s, solved.cost is not None),
        arrangement=record_arrangement(prepared.planned.arrangement),
        space=prepared.space,
        branches=record_branches(solved.plan, library),
    )


def make_arrival_event(answer: PreparedTask | NotStarted, library: SkillLibrary, now: float, tick: int) -> PlanArrived:
    """Return the event that a task has been prepared, or that it cannot be, in a tick of the loop."""
    if isinstance(answer, NotStarted):
        return PlanArrived(time=now, tick=tick, refused=answer.reason, detail=answer.detail, proved=answer.proved)
    planned = answer.planned
    if planned is None:
        return PlanArrived(time=now, tick=tick, space=answer.space)
    return PlanArrived(
        time=now, tick=tick, plan=record_plan(planned.solved, planned.arrangement, library, answer.space)
    )


def read_arrival(event: PlanArrived, assignment: Assignment, library: SkillLibrary) -> PreparedTask | NotStarted:
    """Return the answer that an event records, for the same assignment; PlanError if the plan does not work."""
    if event.refused:
        return NotStarted(event.refused, event.detail, event.proved)
    if event.plan is not None:
        return arrange_prepared(assignment, restore_plan(event.plan), library, event.plan.space)
    assert isinstance(assignment.objective, ExecuteBody), "a goal needs a plan"
    return PreparedTask(assignment, assignment.objective.body, None, event.space)
