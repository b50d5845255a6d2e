"""The recordings of operations."""

from __future__ import annotations

import asyncio
import os
import time
from collections.abc import AsyncIterator
from http import HTTPStatus
from pathlib import Path
from typing import BinaryIO

from starlette.responses import Response, StreamingResponse

from skillc.cells.recordings import recording_file
from skillc.server.endpoint import ApiCall, ApiEndpoint
from skillc.server.problems import ApiRefusal
from skillc.services.recordings import MCAP_MAGIC
from skillc_runtime.execution.task_state import ENDS

MEDIA_TYPE = "application/octet-stream"
PIECE_BYTES = 1 << 18
LOOKS, LOOK_S = 40, 0.05
"""How often, and how long apart in s, it is looked whether a recording is complete."""


async def read_recording(call: ApiCall) -> Response:
    cell, operation = call.server.find_operation(call.path["operation"])
    path = recording_file(Path(cell.settings.folder), operation.id)
    if operation.state in ENDS:
        await _wait_until_complete(path)
    try:
        file = path.open("rb")
    except OSError as error:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no recording of {operation.id}") from error
    size = path.stat().st_size
    headers = {
        "Cache-Control": "no-store",
        "X-Content-Type-Options": "nosniff",
        "Content-Length": str(size),
        "Content-Disposition": f'attachment; filename="{operation.id}.mcap"',
    }
    return StreamingResponse(_read_pieces(file, size), headers=headers, media_type=MEDIA_TYPE)


async def _wait_until_complete(path: Path) -> None:
    """Wait a little for the end of a file whose operation has just ended; that of a dead process never comes."""
    for _ in range(LOOKS):
        if not await asyncio.to_thread(_is_being_completed, path):
            return
        await asyncio.sleep(LOOK_S)


def _is_being_completed(path: Path) -> bool:
    """Whether a file was written lately and has no end yet."""
    try:
        with path.open("rb") as file:
            status = os.fstat(file.fileno())
            file.seek(max(0, status.st_size - len(MCAP_MAGIC)))
            return file.read() != MCAP_MAGIC and time.time() - status.st_mtime < LOOKS * LOOK_S
    except OSError:
        return False


async def _read_pieces(file: BinaryIO, size: int) -> AsyncIterator[bytes]:
    """Yield the first `size` bytes: a recording that goes on grows meanwhile."""
    with file:
        while size > 0 and (piece := await asyncio.to_thread(file.read, min(PIECE_BYTES, size))):
            size -= len(piece)
            yield piece


ENDPOINTS = (
    ApiEndpoint(
        "GET",
        "/operations/{operation}/recording",
        "view",
        "Read the recording of an operation, an MCAP file, as far as it is written",
        read_recording,
        refusals=(HTTPStatus.NOT_FOUND,),
        media_type=MEDIA_TYPE,
    ),
)
