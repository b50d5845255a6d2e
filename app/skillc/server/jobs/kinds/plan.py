"""Plans for a cell: what would be done, or why nothing can be. Nothing moves, and nothing is reserved."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

import msgspec

from skillc.contract.job import PlanResult
from skillc.contract.messages import TakeSnapshot
from skillc.contract.plan import PlanPreview, PlanRequest
from skillc.server.asking import take_snapshot
from skillc.server.http.api_call import ApiCall
from skillc.server.jobs.kind import JobKind, PreparedJob
from skillc.server.jobs.running import RunningJob

if TYPE_CHECKING:
    from skillc.cells.snapshot import CellSnapshot
    from skillc_runtime.planning.plan import Excluded
    from skillc_runtime.planning.schedule import PlanAnswer

GRACE_S = 10.0
"""How long an answer may take after the deadline of the planners, with all that is not search: looks may need 5 s."""


async def _prepare(call: ApiCall, request: PlanRequest) -> PreparedJob:
    cell = call.server.find_cell(request.cell).settings.name

    async def run(job: RunningJob) -> PlanResult:
        work = partial(preview_plan, request)
        return PlanResult(await job.answer(work, PlanPreview, request.deadline_s + GRACE_S))

    return PreparedJob(cell, await take_snapshot(call, cell, TakeSnapshot(beside="arms")), run)


def preview_plan(request: PlanRequest, known: CellSnapshot) -> PlanPreview:
    """Plan for a task or a goal, as an operation would; ServiceError if it is neither, or has errors."""
    from skillc.cells.operations.assigning import assign_request
    from skillc.services.planning.plan_text import describe_answer, format_plan
    from skillc.services.planning.planning import keep_within, plan_goal, prepare_planners
    from skillc.services.space.run_looks import look_from_postures
    from skillc.services.tasks.loading import LoadedTask, with_measure
    from skillc_runtime.cancellation import CancelToken
    from skillc_runtime.execution.assignment import AchieveGoal
    from skillc_runtime.execution.refinement.goal_places import name_goal_places
    from skillc_runtime.execution.refinement.run_planning import plan_for_run
    from skillc_runtime.world.state.model import WorldModel

    assignment = assign_request(request.task, request.goal, None, request.arguments, known.library, known.state)
    loaded = with_measure(LoadedTask(known.library, assignment, WorldModel(known.state)), request.minimise)
    planners, cancel = prepare_planners(True), CancelToken(request.deadline_s)

    def plan(without: Sequence[Excluded]) -> PlanAnswer:
        return plan_goal(loaded, planners, cancel, without=without, prove=request.prove)

    if request.geometry and not known.library.vocabulary.symbolic:
        look = look_from_postures(known.postures, known.library)
        answer, space = plan_for_run(known.library, known.state, plan, look, cancel)
        if isinstance(assignment.objective, AchieveGoal):
            answer = name_goal_places(answer, assignment.objective.goal, known.state)
    else:
        answer, space = plan(()), None
    answer, space = keep_within(answer, space, loaded)
    text = format_plan(answer, loaded, space)
    described = {**describe_answer(answer, loaded, space), "sequence": known.sequence, "text": text}
    return msgspec.convert(described, PlanPreview)


KIND = JobKind(PlanRequest, _prepare, "plans", role="view")
