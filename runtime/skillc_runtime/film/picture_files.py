"""Writes pictures to files: as a film, or one by one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.image import imsave

from skillc_runtime.film.rendering import Picture


class FilmError(RuntimeError):
    """The film cannot be written here; the message says what is missing."""


def write_film(path: Path, pictures: Iterable[Picture], width: int, height: int, rate: int) -> None:
    """Write pictures (height, width, 3) as MP4 of `rate` pictures a second, completely or not at all.

    Raises FilmError if that is not possible, OSError if the path cannot be written.
    """
    try:
        import av
    except ImportError as error:
        raise FilmError("films need PyAV: pip install 'skillc[video]'") from error
    with _partial_file(path) as partial, av.open(str(partial), "w", format="mp4") as container:
        stream: Any = container.add_stream("libx264", rate=rate)
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        for picture in pictures:
            frame = av.VideoFrame.from_ndarray(np.ascontiguousarray(picture), format="rgb24")
            container.mux(stream.encode(frame))
        container.mux(stream.encode())


def write_picture(path: Path, picture: Picture) -> None:
    """Write a picture as PNG, completely or not at all; OSError if the path cannot be written."""
    with _partial_file(path) as partial:
        imsave(partial, np.ascontiguousarray(picture), format="png", metadata={"Software": ""})


@contextmanager
def _partial_file(path: Path) -> Iterator[Path]:
    """Yield a path to write to, which replaces `path` at the end."""
    partial = path.with_name(f"{path.name}.part")
    try:
        yield partial
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)
