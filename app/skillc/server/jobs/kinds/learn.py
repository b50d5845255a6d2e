"""Learning: parameters of skills from trials in the scene of a cell, one candidate after the other, as `skillc learn`.

The study is in the folder of the job: learning that is begun again goes on with the candidates that are missing.
"""

from __future__ import annotations

import shutil
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from http import HTTPStatus
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from skillc.contract.job import RECORDING
from skillc.contract.learning import LearnRequest, LearnResult
from skillc.server.asking import ask_with, take_snapshot
from skillc.server.http.api_call import ApiCall
from skillc.server.jobs.kind import CHECK_S, JobKind, PreparedJob
from skillc.server.jobs.running import RunningJob
from skillc.server.problems import ApiRefusal

if TYPE_CHECKING:
    from skillc.cells.settings import CellSettings
    from skillc.cells.snapshot import CellSnapshot
    from skillc.services.learning.coordinator import LearnOrder

PREPARATION_S = 600.0
"""How long loading, planning and the run that shows what can be learned may take, in s."""


class CandidateDone(msgspec.Struct, frozen=True):
    """How many trials there were once one more candidate was tried, and how many candidates the front has."""

    trials: int
    front: int


async def _prepare(call: ApiCall, request: LearnRequest) -> PreparedJob:
    if request.spec.apply:
        why = "a job does not change the texts of a library; apply the `learned.diff` that it leaves"
        raise ApiRefusal(HTTPStatus.UNPROCESSABLE_ENTITY, why)
    settings = call.server.find_cell(request.cell).settings
    known = await take_snapshot(call, settings.name)
    await ask_with(call, partial(check_learning, request, settings), known, type(None), CHECK_S)
    return PreparedJob(settings.name, b"", partial(_run, request, settings), request.spec.candidates)


async def _run(request: LearnRequest, settings: CellSettings, job: RunningJob) -> LearnResult:
    spec = request.spec
    for number in range(len(job.parts) + 1, spec.candidates + 1):
        limit_s = PREPARATION_S + (spec.trials + 1) * spec.deadline_s
        work = partial(try_candidates, request, settings, job.folder, number)
        done = await job.answer(work, CandidateDone, limit_s)
        message = f"candidate {number}: {done.trials} trials, {done.front} in the front"
        job.add_part(msgspec.json.encode(done), message, True)
    limit_s = PREPARATION_S + (2 * spec.fresh + 1) * spec.deadline_s
    return await job.answer(partial(conclude, request, settings, job.folder), LearnResult, limit_s)


def check_learning(request: LearnRequest, settings: CellSettings, known: CellSnapshot) -> None:
    """Raise RequestError, DiagnosticsError, ServiceError or MissingExtraError for what cannot be learned."""
    from skillc.contract.trials import TrialsRequest
    from skillc.extras import require
    from skillc.server.jobs.kinds.trials import check_trials
    from skillc.services.learning.expressions import check_expressions
    from skillc.services.learning.samplers import require_sampler

    require("learning", "learn")
    check_expressions(*request.spec.expressions)
    require_sampler(request.spec.sampler)
    check_trials(TrialsRequest(task=request.task, arguments=request.arguments), settings.scene, known)


def try_candidates(request: LearnRequest, settings: CellSettings, folder: Path, number: int) -> CandidateDone:
    """Go on with a study until so many candidates are tried; errors as of `learn_further`."""
    from skillc.services.learning.coordinator import learn_further
    from skillc.services.reporting.reporter import SilentReporter

    state = learn_further(_make_order(request, settings, folder), number, SilentReporter())
    return CandidateDone(state.trials, len(state.front))


def conclude(request: LearnRequest, settings: CellSettings, folder: Path) -> LearnResult:
    """Compare the best candidate with the defaults, and write the page; errors as of `learn`."""
    from msgspec import structs

    from skillc.services.learning.coordinator import learn, watch_nothing
    from skillc.services.learning.page import write_page
    from skillc.services.reporting.reporter import SilentReporter

    learned = learn(_make_order(request, settings, folder), watch_nothing, SilentReporter())
    if (recorded := Path(learned.recordings.get("learned", ""), RECORDING)).is_file():
        shutil.copyfile(recorded, folder / RECORDING)
    write_page(structs.replace(learned, recordings={}), folder)
    chosen = () if learned.chosen is None else learned.candidate(learned.chosen).values
    compared = learned.fresh.objectives if learned.fresh else ()
    return LearnResult(
        task=learned.task,
        candidates=len(learned.candidates),
        values={of.name: value for of, value in zip(learned.parameters, chosen, strict=False)},
        objectives={each.objective: (each.defaults, each.learned) for each in compared},
        confirmed=learned.is_confirmed,
        diff=learned.diff,
    )


def _make_order(request: LearnRequest, settings: CellSettings, folder: Path) -> LearnOrder:
    """Return what is learned: one trial runs at a time, for cells go on beside them."""
    from skillc.services.learning.coordinator import LearnOrder
    from skillc.services.library.files import find_scene

    task, scene = f"{settings.library}:{request.task}", find_scene(Path(settings.scene))
    return LearnOrder(task, request.spec, folder, partial(ThreadPoolExecutor, 1), 1, request.arguments, scene)


KIND = JobKind(LearnRequest, _prepare, "trials")
