"""Reports of operations, with figures and film."""

from __future__ import annotations

from http import HTTPStatus
from pathlib import Path

from starlette.responses import Response

from skillc.cells.operations.recording_files import recording_file
from skillc.contract.messages import TakeSnapshot
from skillc.contract.report import REPORT_TYPES, OperationReport
from skillc.server.http.api_call import ApiCall
from skillc.server.http.files import send_file
from skillc.server.http.outcome import raise_refused
from skillc.server.problems import ApiRefusal
from skillc.server.simulation_jobs import MAX_WAITING
from skillc_runtime.recording.states import ENDS

SANDBOX = "sandbox; default-src 'none'; img-src data:; style-src 'unsafe-inline'; media-src data:"
"""What a browser lets a page of a report do: show itself."""


async def make_report(call: ApiCall) -> OperationReport:
    cell, operation = call.server.find_operation(call.path["operation"])
    if operation.state not in ENDS:
        raise ApiRefusal(
            HTTPStatus.CONFLICT, f"{operation.id} is {operation.state}: a report is made of what has ended"
        )
    recording = recording_file(Path(cell.settings.folder), operation.id)
    if not recording.exists():
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no recording of {operation.id}")
    if call.server.jobs.full:
        raise ApiRefusal(HTTPStatus.TOO_MANY_REQUESTS, f"{MAX_WAITING} simulations wait or go on; try again later")
    snapshot = raise_refused(await cell.request(TakeSnapshot()))
    return call.server.reports.begin(operation.id, recording, call.body.film, snapshot)


async def show_report(call: ApiCall) -> OperationReport:
    name = call.path["operation"]
    if (found := call.server.reports.find(name)) is None:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"no report of `{name}` was made; POST makes one")
    return found


async def read_report_file(call: ApiCall) -> Response:
    operation, file = call.path["operation"], call.path["file"]
    found = call.server.reports.find_file(operation, file)
    if found is None:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"the report of `{operation}` has no file `{file}`")
    response = send_file(found, REPORT_TYPES[found.suffix])
    response.headers["Content-Security-Policy"] = SANDBOX
    return response


async def remove_report(call: ApiCall) -> None:
    call.server.reports.remove((await show_report(call)).operation)
