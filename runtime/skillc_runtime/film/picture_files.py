"""Writes pictures to files: as a film, as a short film that repeats, or one by one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any, Literal

import numpy as np
from PIL import Image

from skillc_runtime.film.rendering import Picture

PRESET, CRF = "veryfast", "24"
"""How much x264 compresses for how long, and the quality it keeps."""

PNG_LEVEL = 3
"""How much pictures are compressed: more takes three times as long for a twentieth less."""

LOOP_EVERY, LOOP_RATE = 2, 12.5
"""Every second picture of a film is in its loop, so many of these are shown in a second."""

LOOP_WIDTHS = (800, 640, 560, 480, 400, 320)
"""Widths in pixels of a loop, the greatest first that keeps it small enough."""

COLOURS = 200
"""Number of colours of a GIF."""

LOOP_BYTES = 4_000_000
"""A loop is not larger than this."""


class FilmError(RuntimeError):
    """The film cannot be written here; the message says what is missing."""


def write_film(path: Path, pictures: Iterable[Picture], width: int, height: int, rate: int) -> None:
    """Write pictures (height, width, 3) as MP4 of `rate` pictures a second, completely or not at all.

    Raises FilmError if that is not possible, OSError if the path cannot be written.
    """
    try:
        import av
    except ImportError as error:
        raise FilmError("films need PyAV: pip install 'skillc[run]'") from error
    with _partial_file(path) as partial, av.open(str(partial), "w", format="mp4") as container:
        stream: Any = container.add_stream("libx264", rate=rate, options={"preset": PRESET, "crf": CRF})
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        for picture in pictures:
            frame = av.VideoFrame.from_ndarray(np.ascontiguousarray(picture), format="rgb24")
            container.mux(stream.encode(frame))
        container.mux(stream.encode())


def write_picture(path: Path, picture: Picture) -> None:
    """Write a picture as PNG, completely or not at all; OSError if the path cannot be written."""
    with _partial_file(path) as partial:
        Image.fromarray(picture).save(partial, format="png", compress_level=PNG_LEVEL)


class LoopPictures:
    """Keeps reduced pictures of a film, and writes them as a short film that starts again when it ends."""

    def __init__(self) -> None:
        self._images: list[Image.Image] = []

    def keep(self, pictures: Iterable[Picture]) -> Iterator[Picture]:
        """Yield the pictures, and keep some of them."""
        for number, picture in enumerate(pictures):
            if number % LOOP_EVERY == 0:
                self._images.append(_reduced(Image.fromarray(picture), LOOP_WIDTHS[0]))
            yield picture

    def write(self, path: Path, limit: int = LOOP_BYTES) -> None:
        """Write a GIF or an animated WebP, by the path's suffix, of at most `limit` bytes.

        FilmError if that is too few for the smallest one, OSError if the path cannot be written.
        """
        kind: Literal["gif", "webp"] = "gif" if path.suffix == ".gif" else "webp"
        for width in LOOP_WIDTHS:
            written = _encode_loop([_reduced(each, width) for each in self._images], kind)
            if len(written) <= limit:
                with _partial_file(path) as partial:
                    partial.write_bytes(written)
                return
        raise FilmError(f"{len(self._images)} pictures make no loop of at most {limit / 1e6:g} MB")


def _reduced(image: Image.Image, width: int) -> Image.Image:
    if image.width == width:
        return image
    return image.resize((width, round(width * image.height / image.width)), Image.Resampling.LANCZOS)


def few_colours(image: Image.Image) -> Image.Image:
    """Return a picture with few colours, among them those of small things."""
    return image.quantize(COLOURS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)


def _side_by_side(images: Sequence[Image.Image]) -> Image.Image:
    return Image.fromarray(np.concatenate([np.asarray(each) for each in images], axis=1))


def _encode_loop(images: Sequence[Image.Image], kind: Literal["gif", "webp"]) -> bytes:
    """Return pictures of equal size as a file that repeats for ever."""
    written, interval_ms = BytesIO(), round(1000 / LOOP_RATE)
    if kind == "gif":
        palette = few_colours(_side_by_side([images[0], images[len(images) // 2], images[-1]]))
        images = [each.quantize(palette=palette, dither=Image.Dither.NONE) for each in images]
        images[0].save(written, kind, save_all=True, append_images=images[1:], duration=interval_ms, loop=0)
    else:
        images[0].save(
            written, kind, save_all=True, append_images=images[1:], duration=interval_ms, loop=0, quality=70, method=2
        )
    return written.getvalue()


@contextmanager
def _partial_file(path: Path) -> Iterator[Path]:
    """Yield a path to write to, which replaces `path` at the end."""
    partial = path.with_name(f"{path.name}.part")
    try:
        yield partial
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)
