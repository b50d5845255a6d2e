"""Files as answers, in pieces."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from http import HTTPStatus
from pathlib import Path
from typing import BinaryIO

from starlette.responses import Response, StreamingResponse

from skillc.server.problems import ApiRefusal

PIECE_BYTES = 1 << 18


def send_file(path: Path, media_type: str, name: str = "") -> Response:
    """Return an answer with a file as it is now, to be saved as `name` unless that is empty; ApiRefusal without it."""
    try:
        file = path.open("rb")
    except OSError as error:
        raise ApiRefusal(HTTPStatus.NOT_FOUND, f"{name or path.name} is not there") from error
    size = path.stat().st_size
    headers = {"Cache-Control": "no-store", "X-Content-Type-Options": "nosniff", "Content-Length": str(size)}
    if name:
        headers["Content-Disposition"] = f'attachment; filename="{name}"'
    return StreamingResponse(_read_pieces(file, size), headers=headers, media_type=media_type)


async def _read_pieces(file: BinaryIO, size: int) -> AsyncIterator[bytes]:
    """Yield the first `size` bytes: the file may grow meanwhile."""
    with file:
        while size > 0 and (piece := await asyncio.to_thread(file.read, min(PIECE_BYTES, size))):
            size -= len(piece)
            yield piece
