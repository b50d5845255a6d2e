"""Plans for a cell: what would be done, or why nothing can be."""

from __future__ import annotations

from http import HTTPStatus

from skillc.contract.jobs import Measure, PreviewPlan
from skillc.contract.messages import TakeSnapshot
from skillc.contract.plan import PlanPreview, PlanRequest
from skillc.server.asking import ask_about
from skillc.server.http.api_call import ApiCall
from skillc.server.problems import ApiRefusal

GRACE_S = 10.0
"""How long an answer may take after the deadline of the planners, with all that is not search: looks may need 5 s."""


async def preview_plan(call: ApiCall) -> PlanPreview:
    wanted: PlanRequest = call.body
    if wanted.prove and wanted.minimise == "makespan":
        raise ApiRefusal(HTTPStatus.UNPROCESSABLE_ENTITY, "`prove` is for the work; a makespan has a lower bound")
    measure: Measure = "makespan" if wanted.minimise == "makespan" else "proven work" if wanted.prove else "work"
    job = PreviewPlan(wanted.task, wanted.goal, wanted.arguments, measure, wanted.deadline_s, wanted.geometry)
    return await ask_about(call, job, PlanPreview, wanted.deadline_s + GRACE_S, TakeSnapshot(beside="arms"))
