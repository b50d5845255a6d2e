"""Jobs: work for cells that takes its time, of whatever kind."""

from __future__ import annotations

import asyncio
from http import HTTPStatus
from pathlib import Path

from msgspec import structs
from starlette.responses import Response

from skillc.contract.job import (
    FILE_TYPES,
    ONGOING,
    Job,
    JobEvent,
    JobEventPage,
    JobRequest,
    JobResult,
)
from skillc.server.access.roles import includes
from skillc.server.http.api_call import ApiCall
from skillc.server.http.files import send_file
from skillc.server.jobs.kinds import find_kinds
from skillc.server.problems import ApiRefusal
from skillc_runtime.recording.envelope import make_run_id

KINDS = find_kinds()
SANDBOX = "sandbox; default-src 'none'; img-src data:; style-src 'unsafe-inline'; media-src data:"
"""What a browser lets a page that a job has left do: show itself."""


async def add_job(call: ApiCall) -> Job:
    request: JobRequest = call.body
    name = make_run_id(getattr(request, "task", None) or str(type(request).__struct_config__.tag))
    return await _begin(call, Job(id=name, cell="", owner=call.client.name, request=request))


async def list_jobs(call: ApiCall) -> tuple[Job, ...]:
    name: str | None = call.query.cell
    return call.server.jobs.store.list(None if name is None else call.server.find_cell(name).settings.name)


async def show_job(call: ApiCall) -> Job:
    return call.server.jobs.find(call.path["job"])


async def show_job_result(call: ApiCall) -> JobResult:
    job, store = await show_job(call), call.server.jobs.store
    summarise = KINDS[type(job.request)].summarise
    found = store.find_outcome(job.id) if summarise is None else summarise(job, store.parts(job.id))
    if found is None:
        raise ApiRefusal(HTTPStatus.CONFLICT, f"{job.id} is {job.state}{f': {job.reason}' * bool(job.reason)}")
    return JobResult(job.id, found)


async def list_job_events(call: ApiCall) -> tuple[JobEvent, ...]:
    page: JobEventPage = call.query
    jobs, name = call.server.jobs, call.path["job"]
    with call.server.hub.listening() as listener:
        leaving = asyncio.ensure_future(call.leave())
        try:
            end = asyncio.get_running_loop().time() + page.wait_s
            while not (found := jobs.store.events(name, page.after)) and jobs.find(name).state in ONGOING:
                rest_s = end - asyncio.get_running_loop().time()
                if rest_s <= 0.0 or leaving.done():
                    break
                taking = asyncio.ensure_future(listener.take())
                await asyncio.wait((taking, leaving), timeout=rest_s, return_when=asyncio.FIRST_COMPLETED)
                taking.cancel()
        finally:
            leaving.cancel()
    jobs.find(name)
    return found


async def read_job_file(call: ApiCall) -> Response:
    job, file = await show_job(call), call.path["file"]
    if file not in job.files:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"{job.id} has left no file `{file}`")
    response = send_file(call.server.jobs.folder / job.id / file, FILE_TYPES[Path(file).suffix])
    response.headers["Content-Security-Policy"] = SANDBOX
    return response


async def cancel_job(call: ApiCall) -> Job:
    job = await show_job(call)
    _check_role(call, job)
    call.server.jobs.cancel(job.id, f"by {call.client.name}")
    return await show_job(call)


async def restart_job(call: ApiCall) -> Job:
    job = await show_job(call)
    if job.state in (*ONGOING, "ended"):
        raise ApiRefusal(HTTPStatus.CONFLICT, f"{job.id} is {job.state}: nothing is left to be done again")
    return await _begin(call, job)


async def remove_job(call: ApiCall) -> None:
    job = await show_job(call)
    _check_role(call, job)
    call.server.jobs.remove(job.id)


async def _begin(call: ApiCall, job: Job) -> Job:
    """Do what a job requests, as its cell is now; ApiRefusal if that cannot be done."""
    kind = KINDS[type(job.request)]
    _check_role(call, job)
    call.server.jobs.check_room(kind.lane)
    prepared = await kind.prepare(call, job.request)
    call.server.jobs.check_room(kind.lane)
    job = structs.replace(job, cell=prepared.cell, wanted=prepared.wanted)
    return call.server.jobs.begin(job, kind.lane, prepared.snapshot, prepared.run)


def _check_role(call: ApiCall, job: Job) -> None:
    """Raise ApiRefusal (403) if a client may not have such a job of its own, or of another client, done or ended."""
    needed = KINDS[type(job.request)].role if job.owner == call.client.name else "operate"
    if not includes(call.client.role, needed):
        raise ApiRefusal(
            HTTPStatus.FORBIDDEN, f"this needs the role `{needed}`, and `{call.client.name}` has `{call.client.role}`"
        )
