"""Trials: a task that is run many times from the scene of a cell, in simulation."""

from __future__ import annotations

from http import HTTPStatus

from starlette.responses import Response

from skillc.contract.api.endpoints import BINARY
from skillc.contract.jobs import CheckTrials
from skillc.contract.messages import TakeSnapshot
from skillc.contract.trials import TrialReplay, TrialSeries, TrialsRequest
from skillc.server.asking import ask_about
from skillc.server.http.api_call import ApiCall
from skillc.server.http.files import send_file
from skillc.server.http.outcome import raise_refused
from skillc.server.problems import ApiRefusal
from skillc.server.simulation_jobs import MAX_WAITING
from skillc.server.trials.running import MAX_UNFINISHED
from skillc_runtime.evaluation.trials.series import Series

MAX_DIGITS = 12
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


async def replay_trial(call: ApiCall) -> TrialReplay:
    series, seed = await _find_trial(call)
    if call.server.jobs.full:
        raise ApiRefusal(HTTPStatus.TOO_MANY_REQUESTS, f"{MAX_WAITING} simulations wait or go on; try again later")
    cell = call.server.find_cell(series.cell)
    known = raise_refused(await cell.request(TakeSnapshot()))
    return call.server.trial_replays.begin(series, seed, cell.settings.scene, known)


async def show_replay(call: ApiCall) -> TrialReplay:
    series, seed = await _find_trial(call)
    if (found := call.server.trial_replays.find(series.id, seed)) is None:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"trial {seed} of {series.id} was not run again; POST does that")
    return found


async def read_replay(call: ApiCall) -> Response:
    found = await show_replay(call)
    recording = call.server.trial_replays.find_recording(found.series, found.seed)
    if recording is None:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no recording of trial {found.seed} of {found.series}")
    return send_file(recording, BINARY, f"{found.series}-{found.seed}.mcap")


async def _find_trial(call: ApiCall) -> tuple[TrialSeries, int]:
    """Return the series and the seed that a request names; ApiRefusal (404) if the series has no trial of this seed."""
    series, seed, wanted = await show_trials(call), call.path["seed"], None
    if seed.isascii() and seed.isdigit() and len(seed) <= MAX_DIGITS:
        wanted = int(seed)
    if wanted is None or wanted not in range(series.request.seed, series.request.seed + series.request.number):
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"{series.id} has no trial with the seed {seed[:MAX_DIGITS]}")
    return series, wanted
