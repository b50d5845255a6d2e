"""Looks at a plan in space, and says which of its steps the arms can carry out, and why not the others."""

from __future__ import annotations

from collections.abc import Sequence

from skillc.extras import install_command, missing_extras
from skillc.services.planning.planning import plan_goal
from skillc.services.tasks.loading import LoadedTask
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import AchieveGoal
from skillc_runtime.planning.makespan.scheduling import keep_apart
from skillc_runtime.planning.plan import Excluded, GaveUp, Unsolvable
from skillc_runtime.planning.progress import ReportProgress, ignore_progress
from skillc_runtime.planning.schedule import PlanAnswer, Planners
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.terms import ARM_DEVICE


def plan_goal_in_space(
    loaded: LoadedTask,
    planners: Planners,
    cancel: CancelToken,
    report: ReportProgress = ignore_progress,
    prove: bool = False,
) -> tuple[PlanAnswer, SpaceClaim | None]:
    """Plan as `plan_goal` does, for a plan that the arms can carry out; return it and what is known of it in space.

    None if there is no arm, or no plan.
    """

    def plan(without: Sequence[Excluded]) -> PlanAnswer:
        return plan_goal(loaded, planners, cancel, report, without, prove)

    if not loaded.assignment.state.instances(ARM_DEVICE):
        return plan(()), None
    if missing_extras("run"):
        answer = plan(())
        if isinstance(answer, Unsolvable | GaveUp):
            return answer, None
        why = f"what looks at it is not installed: {install_command('run')}"
        return answer, SpaceClaim(checked=0, steps=len(answer.plan.steps), stopped=why)
    # The simulator is slow to import.
    from skillc_runtime.execution.refinement.goal_places import name_goal_places
    from skillc_runtime.execution.refinement.replanning import plan_in_space
    from skillc_runtime.execution.refinement.space_claim import make_claim

    answer, found = plan_in_space(loaded.library, loaded.assignment.state, plan, cancel)
    if isinstance(loaded.assignment.objective, AchieveGoal):
        answer = name_goal_places(answer, loaded.assignment.objective.goal, loaded.assignment.state)
    if found is None or isinstance(answer, Unsolvable | GaveUp):
        return answer, None
    claim = make_claim(found, len(answer.plan.steps), loaded.library.vocabulary)
    known = loaded.assignment.plan_library(loaded.library)
    return keep_apart(answer, claim.apart_pairs, known, loaded.assignment.state), claim
