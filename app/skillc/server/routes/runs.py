"""What operations have done, and why: their trees, explanations, signals and differences."""

from __future__ import annotations

from pathlib import Path

from skillc.cells.operations.recording_files import recording_file
from skillc.contract.runs.explanation import RunExplanation
from skillc.contract.runs.run_diff import RunDiff
from skillc.contract.runs.run_questions import CompareRuns, ExplainRun, ReadSignals, RunFiles, ShowTree
from skillc.contract.runs.run_tree import OperationTree
from skillc.contract.runs.signals import SignalPage, SignalRows
from skillc.server.asking import ask_about_run
from skillc.server.http.api_call import ApiCall
from skillc.server.routes.recordings import wait_until_complete
from skillc_runtime.recording.states import ENDS

READ_S = 20.0
"""How long reading a run may take, in s."""


async def show_tree(call: ApiCall) -> OperationTree:
    return await ask_about_run(call, ShowTree(_find_files(call, call.path["operation"])), OperationTree, READ_S)


async def explain_run(call: ApiCall) -> RunExplanation:
    job = ExplainRun(_find_files(call, call.path["operation"]), call.query.question)
    return await ask_about_run(call, job, RunExplanation, READ_S)


async def read_signals(call: ApiCall) -> SignalRows:
    page: SignalPage = call.query
    match = tuple(filter(None, page.match.split(",")))
    files = await _find_recorded(call, call.path["operation"])
    job = ReadSignals(files, match, page.after_s, page.until_s, page.every_s)
    return await ask_about_run(call, job, SignalRows, READ_S)


async def compare_runs(call: ApiCall) -> RunDiff:
    first = await _find_recorded(call, call.path["operation"])
    job = CompareRuns(first, await _find_recorded(call, call.query.other))
    return await ask_about_run(call, job, RunDiff, READ_S)


async def _find_recorded(call: ApiCall, name: str) -> RunFiles:
    """Return where an operation is recorded, once the recording of one that has ended is complete; ApiRefusal (404)."""
    files = _find_files(call, name)
    if call.server.find_operation(name)[1].state in ENDS:
        await wait_until_complete(Path(files.recording))
    return files


def _find_files(call: ApiCall, name: str) -> RunFiles:
    """Return where an operation is recorded; ApiRefusal (404) if there is none of this id."""
    cell, operation = call.server.find_operation(name)
    recording = recording_file(Path(cell.settings.folder), operation.id)
    return RunFiles(operation.id, str(cell.settings.journal), str(recording))
