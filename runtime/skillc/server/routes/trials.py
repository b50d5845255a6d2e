"""Trials: a task that is run many times from the scene of a cell, in simulation."""

from __future__ import annotations

from http import HTTPStatus

from skillc.cells.messages import TakeSnapshot
from skillc.server.asking import ask_about
from skillc.server.endpoint import ApiCall, ApiEndpoint
from skillc.server.outcome import UNAVAILABLE, raise_refused
from skillc.server.problems import ApiRefusal
from skillc.server.trials.running import MAX_UNFINISHED
from skillc.server.trials.store import TrialSeries
from skillc.workers.jobs import CheckTrials, TrialsRequest
from skillc_runtime.evaluation.trials.series import Series

CHECK_S = 20.0
"""How long checking a request may take, in s."""


async def run_trials(call: ApiCall) -> TrialSeries:
    cell, trials, request = call.server.find_cell(call.path["cell"]), call.server.trials, call.body
    assert isinstance(request, TrialsRequest), "the endpoint decodes it"
    if trials.full:
        raise ApiRefusal(HTTPStatus.TOO_MANY_REQUESTS, f"{MAX_UNFINISHED} series wait or go on; try again later")
    scene = cell.settings.scene
    await ask_about(call, CheckTrials(request, scene), type(None), CHECK_S)
    known = raise_refused(await cell.request(TakeSnapshot()))
    return trials.begin(cell.settings.name, scene, request, known)


async def list_trials(call: ApiCall) -> tuple[TrialSeries, ...]:
    return call.server.trials.store.list(call.server.find_cell(call.path["cell"]).settings.name)


async def show_trials(call: ApiCall) -> TrialSeries:
    name = call.path["series"]
    if (found := call.server.trials.store.find(name)) is None:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no series of trials `{name}`")
    return found


async def judge_trials(call: ApiCall) -> Series:
    return call.server.trials.store.judge(await show_trials(call))


async def remove_trials(call: ApiCall) -> None:
    call.server.trials.remove((await show_trials(call)).id)


NOT_FOUND = (HTTPStatus.NOT_FOUND,)
PATH = "/trials/{series}"
ENDPOINTS = (
    ApiEndpoint(
        "POST", "/cells/{cell}/trials", "operate", "Run a task many times in simulation, from the scene of a cell",
        run_trials, TrialSeries, body=TrialsRequest, status=HTTPStatus.ACCEPTED, refusals=(*NOT_FOUND, *UNAVAILABLE),
    ),
    ApiEndpoint(
        "GET", "/cells/{cell}/trials", "view", "List the series of trials for a cell", list_trials,
        tuple[TrialSeries, ...], refusals=NOT_FOUND,
    ),
    ApiEndpoint(
        "GET", PATH, "view", "Show how far a series of trials is", show_trials, TrialSeries, refusals=NOT_FOUND,
    ),
    ApiEndpoint(
        "GET", f"{PATH}/result", "view", "Judge the trials of a series that are done", judge_trials, Series,
        refusals=NOT_FOUND,
    ),
    ApiEndpoint(
        "DELETE", PATH, "operate", "End and forget a series of trials", remove_trials, status=HTTPStatus.NO_CONTENT,
        refusals=NOT_FOUND,
    ),
)  # fmt: skip
