"""Plans as they are recorded, and plans from a recording."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.plan import LeftOut, Optimal, Plan, Solved, Step
from skillc_runtime.recording.events import ArrivedPlan, PartLeftOut, PlanStep
from skillc_runtime.world.state.labelled import LabelledIri, label


def record_steps(plan: Plan, library: SkillLibrary) -> tuple[PlanStep, ...]:
    """Return the steps of a plan, in its order, with labelled arguments and the lines of the skills."""
    return tuple(
        PlanStep(
            skill=step.skill,
            arguments={name: label(iri, library.vocabulary) for name, iri in step.arguments.items()},
            source=library.skills[step.skill].source,
        )
        for step in plan.steps
    )


def restore_steps(recorded: Sequence[PlanStep]) -> tuple[Step, ...]:
    """Return the steps of a plan from a recording."""
    return tuple(
        Step(each.skill, {name: value.iri for name, value in each.arguments.items() if isinstance(value, LabelledIri)})
        for each in recorded
    )


def record_plan(solved: Solved, library: SkillLibrary) -> ArrivedPlan:
    """Return a plan for a recording; of what was left out only the kinds and reasons, because it may be a million."""
    return ArrivedPlan(
        planner=solved.planner,
        optimal=solved.optimal,
        duration_s=solved.plan.duration_s,
        steps=record_steps(solved.plan, library),
        left_out=tuple(PartLeftOut(each.kind, each.why, each.harmless) for each in solved.left_out),
        at_least_s=solved.at_least_s,
        assumptions=solved.assumptions,
    )


def restore_plan(recorded: ArrivedPlan) -> Solved:
    """Return a plan from a recording; it describes itself as before, but names no members of what was left out."""
    return Solved(
        plan=Plan(restore_steps(recorded.steps), recorded.duration_s),
        optimal=cast(Optimal, recorded.optimal),
        planner=recorded.planner,
        left_out=tuple(LeftOut((), each.why, each.harmless, each.kind) for each in recorded.left_out),
        at_least_s=recorded.at_least_s,
        assumptions=recorded.assumptions,
    )
