"""What operations have done, and why: their trees, explanations, signals and differences."""

from __future__ import annotations

import asyncio
import os
import time
from functools import partial
from http import HTTPStatus
from pathlib import Path

from starlette.responses import Response

from skillc.cells.operations.recording_files import recording_file
from skillc.contract.api.endpoints import BINARY
from skillc.contract.runs.explanation import RunExplanation
from skillc.contract.runs.run_diff import RunDiff
from skillc.contract.runs.run_tree import OperationTree
from skillc.contract.runs.signals import SignalPage, SignalRows
from skillc.server.asking import ask_about_run
from skillc.server.http.api_call import ApiCall
from skillc.server.http.files import send_file
from skillc.server.problems import ApiRefusal
from skillc.services.recording.recordings import MCAP_MAGIC
from skillc.workers import run_reading
from skillc.workers.run_reading import RunFiles
from skillc_runtime.recording.mcap.contents import CLOSE_S
from skillc_runtime.recording.states import ENDS

LOOK_S = 0.05
"""How long apart it is looked whether a recording is complete, in s."""


async def read_recording(call: ApiCall) -> Response:
    cell, operation = call.server.find_operation(call.path["operation"])
    path = recording_file(Path(cell.settings.folder), operation.id)
    if operation.state in ENDS:
        await wait_until_complete(path)
    if not path.exists():
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no recording of {operation.id}")
    return send_file(path, BINARY, f"{operation.id}.mcap")


async def wait_until_complete(path: Path) -> None:
    """Wait for the end of a file whose operation has just ended; that of a dead process never comes."""
    for _ in range(round(CLOSE_S / LOOK_S)):
        if not await asyncio.to_thread(_is_being_completed, path):
            return
        await asyncio.sleep(LOOK_S)


def _is_being_completed(path: Path) -> bool:
    """Whether a file was written lately and has no end yet."""
    try:
        with path.open("rb") as file:
            status = os.fstat(file.fileno())
            file.seek(max(0, status.st_size - len(MCAP_MAGIC)))
            return file.read() != MCAP_MAGIC and time.time() - status.st_mtime < CLOSE_S
    except OSError:
        return False


READ_S = 20.0
"""How long reading a run may take, in s."""


async def show_tree(call: ApiCall) -> OperationTree:
    work = partial(run_reading.show_tree, _find_files(call, call.path["operation"]))
    return await ask_about_run(call, work, OperationTree, READ_S)


async def explain_run(call: ApiCall) -> RunExplanation:
    work = partial(run_reading.explain_run, _find_files(call, call.path["operation"]), call.query.question)
    return await ask_about_run(call, work, RunExplanation, READ_S)


async def read_signals(call: ApiCall) -> SignalRows:
    page: SignalPage = call.query
    files = await _find_recorded(call, call.path["operation"])
    return await ask_about_run(call, partial(run_reading.read_signals, files, page), SignalRows, READ_S)


async def compare_runs(call: ApiCall) -> RunDiff:
    first = await _find_recorded(call, call.path["operation"])
    work = partial(run_reading.compare_runs, first, await _find_recorded(call, call.query.other))
    return await ask_about_run(call, work, RunDiff, READ_S)


async def _find_recorded(call: ApiCall, name: str) -> RunFiles:
    """Return where an operation is recorded, once the recording of one that has ended is complete; ApiRefusal (404)."""
    files = _find_files(call, name)
    if call.server.find_operation(name)[1].state in ENDS:
        await wait_until_complete(files.recording)
    return files


def _find_files(call: ApiCall, name: str) -> RunFiles:
    """Return where an operation is recorded; ApiRefusal (404) if there is none of this id."""
    cell, operation = call.server.find_operation(name)
    recording = recording_file(Path(cell.settings.folder), operation.id)
    return RunFiles(operation.id, cell.settings.journal, recording)
