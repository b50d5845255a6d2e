"""Previews a plan for what the cell knows: nothing moves, and nothing is reserved."""

from __future__ import annotations

import msgspec

from skillc.cells.assigning import assign_request
from skillc.cells.snapshot import CellSnapshot
from skillc.contract.jobs import PreviewPlan
from skillc.contract.plan import PlanPreview
from skillc.services.plan_text import describe_answer, format_plan
from skillc.services.planning import plan_goal, prepare_planners
from skillc.services.task_loading import LoadedTask
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.world.state.model import WorldModel


def preview_plan(job: PreviewPlan, known: CellSnapshot) -> PlanPreview:
    """Plan for a task or a goal; ServiceError if it is neither, or has errors."""
    assignment = assign_request(job.task, job.goal, None, job.arguments, known.library, known.state)
    loaded = LoadedTask(known.library, assignment, WorldModel(known.state))
    answer = plan_goal(loaded, job.measure, prepare_planners(True), CancelToken(job.deadline_s))
    described = {**describe_answer(answer, loaded), "sequence": known.sequence, "text": format_plan(answer, loaded)}
    return msgspec.convert(described, PlanPreview)
