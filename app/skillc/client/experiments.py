"""What is tried in simulation for a cell of a server: the client waits for the end, and ends what nobody waits for."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from http import HTTPStatus
from pathlib import Path

from skillc.client.connection import Connection
from skillc.client.errors import RefusedError
from skillc.contract.api.endpoints import (
    JUDGE_TRIALS,
    MAKE_REPORT,
    READ_FILM,
    READ_REPORT_FILE,
    REHEARSE,
    REMOVE_REHEARSAL,
    REMOVE_REPORT,
    REMOVE_TRIALS,
    RUN_TRIALS,
    SHOW_REHEARSAL,
    SHOW_REPORT,
    SHOW_TRIALS,
)
from skillc.contract.rehearsal import Rehearsal, RehearsalRequest
from skillc.contract.report import OperationReport, ReportRequest
from skillc.contract.trials import Series, TrialSeries, TrialsRequest

LOOK_S = 0.3


async def rehearse(connection: Connection, cell: str, request: RehearsalRequest, film: Path | None) -> Rehearsal:
    """Begin a rehearsal for a cell; return it once it has ended, with its film in a file."""
    found = await connection.call(REHEARSE, cell, body=request)
    try:
        while found.state != "ended":  # wait ends: the server limits how long a rehearsal takes
            await asyncio.sleep(LOOK_S)
            found = await connection.call(SHOW_REHEARSAL, found.id)
        if found.result is None:
            raise RefusedError(found.reason, HTTPStatus.CONFLICT)
        if film is not None and found.film:
            await connection.download(READ_FILM, found.id, file=film)
    finally:
        await connection.call(REMOVE_REHEARSAL, found.id)
    return found


async def make_report(connection: Connection, operation: str, folder: Path, film: bool) -> OperationReport:
    """Let the server make the report of an operation, with a film or without, and write its files to a folder."""
    found = await connection.call(MAKE_REPORT, operation, body=ReportRequest(film))
    try:
        while found.state != "ended":  # wait ends: the server limits how long a report takes
            await asyncio.sleep(LOOK_S)
            found = await connection.call(SHOW_REPORT, operation)
        if found.result is None:
            raise RefusedError(found.reason, HTTPStatus.CONFLICT)
        folder.mkdir(parents=True, exist_ok=True)
        for each in found.files:
            await connection.download(READ_REPORT_FILE, operation, each, file=folder / Path(each).name)
    finally:
        await connection.call(REMOVE_REPORT, operation)
    return found


async def run_trials(
    connection: Connection, cell: str, request: TrialsRequest, watch: Callable[[TrialSeries], None] | None
) -> Series:
    """Begin trials for a cell; return them once they have ended, judged. `watch` is called with each progress."""
    found = await connection.call(RUN_TRIALS, cell, body=request)
    try:
        while found.state in ("waiting", "going on"):  # wait ends: each trial has a time limit
            await asyncio.sleep(LOOK_S)
            before, found = found, await connection.call(SHOW_TRIALS, found.id)
            if watch is not None and found != before:
                watch(found)
    except asyncio.CancelledError:
        await connection.call(REMOVE_TRIALS, found.id)
        raise
    if found.reason:
        raise RefusedError(found.reason, HTTPStatus.CONFLICT)
    return await connection.call(JUDGE_TRIALS, found.id)
