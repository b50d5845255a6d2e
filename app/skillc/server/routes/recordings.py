"""The recordings of operations."""

from __future__ import annotations

import asyncio
import os
import time
from http import HTTPStatus
from pathlib import Path

from starlette.responses import Response

from skillc.cells.operations.recording_files import recording_file
from skillc.contract.api.endpoints import BINARY
from skillc.server.http.api_call import ApiCall
from skillc.server.http.files import send_file
from skillc.server.problems import ApiRefusal
from skillc.services.recording.recordings import MCAP_MAGIC
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
