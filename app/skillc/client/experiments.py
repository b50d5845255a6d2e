"""What is tried in simulation for a cell of a server: the client waits for the end, and ends what nobody waits for."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from http import HTTPStatus
from pathlib import Path

from skillc.client.connection import Connection, join
from skillc.client.errors import RefusedError
from skillc.contract.rehearsal import Rehearsal, RehearsalRequest
from skillc.contract.report import OperationReport, ReportRequest
from skillc.contract.trials import Series, TrialSeries, TrialsRequest

LOOK_S = 0.3


async def rehearse(connection: Connection, path: str, request: RehearsalRequest, film: Path | None) -> Rehearsal:
    """Post a rehearsal to a path; return it once it has ended, with its film in a file."""
    found = await connection.send("POST", path, Rehearsal, request)
    try:
        while found.state != "ended":  # wait ends: the server limits how long a rehearsal takes
            await asyncio.sleep(LOOK_S)
            found = await connection.get(join("rehearsals", found.id), Rehearsal)
        if found.result is None:
            raise RefusedError(found.reason, HTTPStatus.CONFLICT)
        if film is not None and found.film:
            await connection.download(join("rehearsals", found.id, "film"), film)
    finally:
        await connection.send("DELETE", join("rehearsals", found.id), type(None))
    return found


async def make_report(connection: Connection, operation: str, folder: Path, film: bool) -> OperationReport:
    """Let the server make the report of an operation, with a film or without, and write its files to a folder."""
    path = join("operations", operation, "report")
    found = await connection.send("POST", path, OperationReport, ReportRequest(film))
    try:
        while found.state != "ended":  # wait ends: the server limits how long a report takes
            await asyncio.sleep(LOOK_S)
            found = await connection.get(path, OperationReport)
        if found.result is None:
            raise RefusedError(found.reason, HTTPStatus.CONFLICT)
        folder.mkdir(parents=True, exist_ok=True)
        for each in found.files:
            await connection.download(join("operations", operation, "report", each), folder / Path(each).name)
    finally:
        await connection.send("DELETE", path, type(None))
    return found


async def run_trials(
    connection: Connection, path: str, request: TrialsRequest, watch: Callable[[TrialSeries], None] | None
) -> Series:
    """Post trials to a path; return them once they have ended, judged. `watch` is called with each progress."""
    found = await connection.send("POST", path, TrialSeries, request)
    try:
        while found.state in ("waiting", "going on"):  # wait ends: each trial has a time limit
            await asyncio.sleep(LOOK_S)
            before, found = found, await connection.get(join("trials", found.id), TrialSeries)
            if watch is not None and found != before:
                watch(found)
    except asyncio.CancelledError:
        await connection.send("DELETE", join("trials", found.id), type(None))
        raise
    if found.reason:
        raise RefusedError(found.reason, HTTPStatus.CONFLICT)
    return await connection.get(join("trials", found.id, "result"), Series)
