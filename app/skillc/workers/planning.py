"""Previews a plan for what the cell knows, as an operation would make it: nothing moves, and nothing is reserved."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from skillc.cells.operations.assigning import assign_request
from skillc.cells.snapshot import CellSnapshot
from skillc.contract.jobs import PreviewPlan
from skillc.contract.plan import PlanPreview
from skillc.services.planning.plan_text import describe_answer, format_plan
from skillc.services.planning.planning import Answer, plan_goal, prepare_planners
from skillc.services.space.run_looks import look_from_postures
from skillc.services.tasks.loading import LoadedTask
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import AchieveGoal
from skillc_runtime.execution.refinement.goal_places import name_goal_places
from skillc_runtime.execution.refinement.run_planning import plan_for_run
from skillc_runtime.planning.plan import Excluded
from skillc_runtime.world.state.model import WorldModel


def preview_plan(job: PreviewPlan, known: CellSnapshot) -> PlanPreview:
    """Plan for a task or a goal; ServiceError if it is neither, or has errors."""
    assignment = assign_request(job.task, job.goal, None, job.arguments, known.library, known.state)
    loaded = LoadedTask(known.library, assignment, WorldModel(known.state))
    planners, cancel = prepare_planners(True), CancelToken(job.deadline_s)

    def plan(without: Sequence[Excluded]) -> Answer:
        return plan_goal(loaded, job.measure, planners, cancel, without=without)

    if job.geometry and not known.library.vocabulary.symbolic:
        look = look_from_postures(known.postures, known.library)
        answer, space = plan_for_run(known.library, known.state, plan, look, cancel)
        if isinstance(assignment.objective, AchieveGoal):
            answer = name_goal_places(answer, assignment.objective.goal, known.state)
    else:
        answer, space = plan(()), None
    text = format_plan(answer, loaded, space)
    described = {**describe_answer(answer, loaded, space), "sequence": known.sequence, "text": text}
    return msgspec.convert(described, PlanPreview)
