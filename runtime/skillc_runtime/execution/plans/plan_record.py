"""Plans as they are recorded, and plans from a recording."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from skillc_model.skills import SkillLibrary
from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Pose
from skillc_runtime.planning.arrangement import Arrangement, InParallel, InSeries
from skillc_runtime.planning.plan import Branch, LeftOut, Optimal, Plan, Solved, Step
from skillc_runtime.primitives.planned_postures import PlannedPosture
from skillc_runtime.recording.recorded_plan import ArrivedPlan, PartLeftOut, PlanBranch, PlanStep, StepGroup
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.labels.labelled import LabelledIri
from skillc_runtime.world.state.labels.labelling import label


def record_steps(plan: Plan, library: SkillLibrary) -> tuple[PlanStep, ...]:
    """Return the steps of a plan, in its order, with labelled arguments and the lines of the skills."""
    return tuple(
        PlanStep(
            skill=step.skill,
            arguments={name: label(iri, library.vocabulary) for name, iri in step.arguments.items()},
            source=library.skills[step.skill].source,
            outcome=step.outcome,
        )
        for step in plan.steps
    )


def restore_steps(recorded: Sequence[PlanStep]) -> tuple[Step, ...]:
    """Return the steps of a plan from a recording."""
    return tuple(
        Step(
            each.skill,
            {name: value.iri for name, value in each.arguments.items() if isinstance(value, LabelledIri)},
            each.outcome,
        )
        for each in recorded
    )


def record_branches(plan: Plan, library: SkillLibrary) -> tuple[PlanBranch, ...]:
    """Return how a policy goes on, for a recording."""
    return tuple(
        PlanBranch(outcome=each.outcome, likely=each.likely)
        if each.plan is None
        else PlanBranch(
            outcome=each.outcome,
            likely=each.likely,
            steps=record_steps(each.plan, library),
            duration_s=each.plan.duration_s,
            branches=record_branches(each.plan, library),
        )
        for each in plan.branches
    )


def restore_branches(recorded: Sequence[PlanBranch]) -> tuple[Branch, ...]:
    """Return how a policy goes on, from a recording."""
    return tuple(
        Branch(
            each.outcome,
            each.likely,
            None
            if each.steps is None
            else Plan(restore_steps(each.steps), each.duration_s, branches=restore_branches(each.branches)),
        )
        for each in recorded
    )


def restore_postures(space: SpaceClaim) -> tuple[PlannedPosture, ...]:
    """Return the postures that arms are to take, from what is known of a plan in space."""
    return tuple(
        PlannedPosture(each.arm.iri, Pose.of(each.tool.position_m, each.tool.quaternion_wxyz), np.array(each.q))
        for each in space.postures
    )


def record_arrangement(arrangement: Arrangement) -> StepGroup:
    """Return an arrangement for a recording; a single step is a group, too."""
    if isinstance(arrangement, int):
        return StepGroup((arrangement,))
    parts = tuple(each if isinstance(each, int) else record_arrangement(each) for each in arrangement.parts)
    if isinstance(arrangement, InParallel):
        return StepGroup(parts, True, arrangement.after)
    return StepGroup(parts)


def restore_arrangement(recorded: StepGroup) -> Arrangement:
    """Return an arrangement from a recording."""
    parts = tuple(each if isinstance(each, int) else restore_arrangement(each) for each in recorded.parts)
    if len(parts) == 1:
        return parts[0]
    return InParallel(parts, recorded.after) if recorded.parallel else InSeries(parts)


def record_plan(
    solved: Solved, arrangement: Arrangement, library: SkillLibrary, space: SpaceClaim | None = None
) -> ArrivedPlan:
    """Return a plan for a recording; of what was left out only the kinds and reasons, because it may be a million.

    `space` is what is known of the plan in space.
    """
    return ArrivedPlan(
        planner=solved.planner,
        optimal=solved.optimal,
        duration_s=solved.plan.duration_s,
        steps=record_steps(solved.plan, library),
        left_out=tuple(PartLeftOut(each.kind, each.why, each.harmless) for each in solved.left_out),
        at_least_s=solved.at_least_s,
        assumptions=solved.assumptions,
        arrangement=record_arrangement(arrangement),
        space=space,
        branches=record_branches(solved.plan, library),
    )


def restore_plan(recorded: ArrivedPlan) -> Solved:
    """Return a plan from a recording; it describes itself as before, but names no members of what was left out."""
    apart = recorded.space.apart_pairs if recorded.space is not None else frozenset[tuple[int, int]]()
    return Solved(
        plan=Plan(restore_steps(recorded.steps), recorded.duration_s, apart, restore_branches(recorded.branches)),
        optimal=cast(Optimal, recorded.optimal),
        planner=recorded.planner,
        left_out=tuple(LeftOut((), each.why, each.harmless, each.kind) for each in recorded.left_out),
        at_least_s=recorded.at_least_s,
        assumptions=recorded.assumptions,
    )
