"""What operations have done, and why: their trees, explanations, signals and differences."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from skillc.cells.operations.recording_files import recording_file
from skillc.contract.runs.explanation import RunExplanation
from skillc.contract.runs.run_diff import RunDiff
from skillc.contract.runs.run_tree import OperationTree
from skillc.contract.runs.signals import SignalPage, SignalRows
from skillc.server.asking import ask_about_run
from skillc.server.http.api_call import ApiCall
from skillc.server.routes.recordings import wait_until_complete
from skillc.workers import run_reading
from skillc.workers.run_reading import RunFiles
from skillc_runtime.recording.states import ENDS

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
