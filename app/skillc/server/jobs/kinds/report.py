"""Reports of operations, with figures and film: each is made by running the operation again from its recording."""

from __future__ import annotations

from functools import partial
from http import HTTPStatus
from pathlib import Path
from typing import TYPE_CHECKING

from skillc.cells.operations.recording_files import recording_file
from skillc.contract.job import ReportRequest, RunResult
from skillc.server.asking import take_snapshot
from skillc.server.http.api_call import ApiCall
from skillc.server.jobs.kind import JobKind, PreparedJob
from skillc.server.jobs.running import SIMULATION_S, RunningJob
from skillc.server.problems import ApiRefusal
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.recording.states import ENDS

if TYPE_CHECKING:
    from skillc.cells.snapshot import CellSnapshot


async def _prepare(call: ApiCall, request: ReportRequest) -> PreparedJob:
    cell, operation = call.server.find_operation(request.operation)
    if operation.state not in ENDS:
        ongoing = f"{operation.id} is {operation.state}: a report is made of what has ended"
        raise ApiRefusal(HTTPStatus.CONFLICT, ongoing)
    recording = recording_file(Path(cell.settings.folder), operation.id)
    if not recording.exists():
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no recording of {operation.id}")

    async def run(job: RunningJob) -> RunResult:
        work = partial(make_report, recording, job.folder, request.film)
        return RunResult(await job.answer(work, TaskResult, SIMULATION_S))

    return PreparedJob(cell.settings.name, await take_snapshot(call, cell.settings.name), run)


def make_report(recording: Path, folder: Path, film: bool, known: CellSnapshot) -> TaskResult:
    """Write the report of a recording to a folder, and return the result; ServiceError if it cannot be made."""
    from skillc.errors import RequestError
    from skillc.services.replaying.report import report_recorded
    from skillc.services.reporting.reporter import SilentReporter
    from skillc_runtime.recording.run_spec import RunSpec

    made = report_recorded(recording, known.library, RunSpec(out=str(folder), film=film), SilentReporter())
    if not made.written:
        raise RequestError("the report cannot be written")
    return made.result


KIND = JobKind(ReportRequest, _prepare, "simulations")
