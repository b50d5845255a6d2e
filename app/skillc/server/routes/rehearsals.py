"""Rehearsals: what an operation does in a simulated twin of a cell, before it is done."""

from __future__ import annotations

from http import HTTPStatus

from starlette.responses import Response

from skillc.contract.api.endpoints import BINARY, VIDEO
from skillc.contract.jobs import CheckOperation
from skillc.contract.messages import TakeSnapshot
from skillc.contract.rehearsal import Rehearsal, RehearsalRequest
from skillc.server.asking import ask_about
from skillc.server.http.api_call import ApiCall
from skillc.server.http.files import send_file
from skillc.server.http.outcome import raise_refused
from skillc.server.problems import ApiRefusal
from skillc.server.routes.world import QUERY_S
from skillc.server.simulation_jobs import MAX_WAITING


async def rehearse(call: ApiCall) -> Rehearsal:
    cell = call.server.find_cell(call.path["cell"])
    if call.server.jobs.full:
        raise ApiRefusal(HTTPStatus.TOO_MANY_REQUESTS, f"{MAX_WAITING} simulations wait or go on; try again later")
    wanted: RehearsalRequest = call.body
    await ask_about(
        call, CheckOperation(wanted.task, wanted.goal, wanted.call, wanted.arguments, ()), type(None), QUERY_S
    )
    twin = raise_refused(await cell.request(TakeSnapshot(beside="devices")))
    return call.server.rehearsals.begin(cell.settings.name, call.body, twin)


async def list_rehearsals(call: ApiCall) -> tuple[Rehearsal, ...]:
    return call.server.rehearsals.list(call.server.find_cell(call.path["cell"]).settings.name)


async def show_rehearsal(call: ApiCall) -> Rehearsal:
    name = call.path["rehearsal"]
    if (found := call.server.rehearsals.find(name)) is None:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no rehearsal `{name}`")
    return found


async def remove_rehearsal(call: ApiCall) -> None:
    call.server.rehearsals.remove((await show_rehearsal(call)).id)


async def read_film(call: ApiCall) -> Response:
    found = await show_rehearsal(call)
    film = call.server.rehearsals.find_film(found.id)
    if film is None:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no film of {found.id}")
    return send_file(film, VIDEO)


async def read_rehearsal_recording(call: ApiCall) -> Response:
    found = await show_rehearsal(call)
    recording = call.server.rehearsals.find_recording(found.id)
    if recording is None:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no recording of {found.id}")
    return send_file(recording, BINARY, f"{found.id}.mcap")
