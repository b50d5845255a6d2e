"""Renders footage: a film from one camera that frames the work, stills from close to a hand, a loop."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.film.annotations import Annotations
from skillc_runtime.film.camera import CameraView
from skillc_runtime.film.captions import STRIP_PIXELS, STRIP_WIDTH, StripText, caption_at, draw_strip
from skillc_runtime.film.footage import Footage
from skillc_runtime.film.frames import FRAMES_PER_S, Frame, Shades
from skillc_runtime.film.framing import Framing, posed
from skillc_runtime.film.picture_files import LoopPictures, write_film, write_picture
from skillc_runtime.film.rendering import FILM_QUALITIES, FilmQuality, Picture, Quality, Renderer

DUSTY, CLEAN = (171.0, 160.0, 140.0), (246.0, 250.0, 252.0)
"""Red, green and blue, to 255, of a surface before work and after it."""

DUST_GRAIN = 9.0
"""How much the brightness of dust varies."""


def colour_surface(shades: Shades) -> NDArray[np.uint8]:
    """Return the colours (rows, columns, 3) of the cells of a surface of shades (rows, columns)."""
    grain = np.random.default_rng(3).uniform(-DUST_GRAIN, DUST_GRAIN, (*shades.shape, 1))
    share = (shades / 255.0)[:, :, np.newaxis]
    return np.asarray((1 - share) * (np.array(DUSTY) + grain) + share * np.array(CLEAN)).astype(np.uint8)


SIZES: dict[FilmQuality, tuple[int, int]] = {"draft": (640, 360), "standard": (960, 540), "fine": (1280, 720)}
"""Width and height of a film in pixels; a strip with captions is at its bottom."""

STILL_SIZE, STILL = (1280, 720), Quality(1.5, 2048, 40)

END_S = 2.0
"""How long the last picture is shown, with how the run ended."""

WORKED = "lighter: the tool worked there (ground truth of the simulator)"

Progress = Callable[[float], None]
"""Reports the share of a film that is rendered."""


def render_film(footage: Footage, directory: Path, progress: Progress = lambda _share: None) -> None:
    """Render all frames to film.mp4, stills of some moments to PNG, and the loop if it is wanted.

    Each file is written completely or not at all.
    Raises FilmError or RenderingError if that is not possible, OSError if the folder cannot be written to.
    """
    width, height = SIZES[footage.quality]
    strip = round(STRIP_PIXELS * width / STRIP_WIDTH)
    framing = Framing(footage.model, footage.prefixes, footage.frames, footage.corners, width / (height - strip))
    pictures = _pictures(footage, framing, (width, height - strip), progress)
    shown = LoopPictures()
    kept = pictures if footage.files.loop is None else shown.keep(pictures)
    write_film(directory / footage.files.film, kept, width, height, FRAMES_PER_S)
    if footage.files.loop is not None:
        shown.write(directory / footage.files.loop)
    for still, picture in zip(footage.files.stills, _stills(footage, framing), strict=True):
        write_picture(directory / still.file, picture)


def _pictures(footage: Footage, framing: Framing, size: tuple[int, int], progress: Progress) -> Iterator[Picture]:
    """Render the pictures of the film, each with a strip below a view of that size."""
    picture, width = np.empty(0, dtype=np.uint8), size[0]
    with _renderer(footage, size, FILM_QUALITIES[footage.quality]) as scene:
        views = zip(footage.frames, footage.marks, framing.work_views(), strict=True)
        for at, (frame, marks, view) in enumerate(views):
            progress(at / len(footage.frames))
            marked = Annotations(frame.annotations.ghosts, (), marks.arrows, marks.trails)
            picture = scene.picture(frame, view, marked)
            force = "" if marks.greatest_n is None else f"presses with {marks.greatest_n:.0f} N"
            did = caption_at(footage.story.captions, frame.time)
            text = StripText(did, _legend(frame), force, _time(footage, frame))
            yield np.concatenate([picture, draw_strip(text, width)])
    ending = footage.story.ending
    if ending is not None:
        text = StripText(ending.text, "", "", _time(footage, footage.frames[-1]), ending.kind)
        for _ in range(round(END_S * FRAMES_PER_S)):
            yield np.concatenate([picture, draw_strip(text, width)])


def _stills(footage: Footage, framing: Framing) -> Iterator[Picture]:
    """Render close views of the moments."""
    if not footage.story.moments:
        return
    frames = footage.frames
    with _renderer(footage, STILL_SIZE, STILL) as scene:
        for moment in footage.story.moments:
            since_s = moment.time - frames[0].time
            at = min(round(since_s * FRAMES_PER_S / footage.speed_up), len(frames) - 1)
            shown = replace(frames[at].annotations, arrows=footage.marks[at].arrows)
            yield scene.picture(frames[at], framing.hand_view(at, moment.arm), shown)


@contextmanager
def _renderer(footage: Footage, size: tuple[int, int], quality: Quality) -> Iterator[_FrameRenderer]:
    renderer = Renderer(footage.model, *size, footage.props, quality)
    try:
        yield _FrameRenderer(renderer, footage.model, footage.textures)
    finally:
        renderer.close()


@dataclass(frozen=True, slots=True)
class _FrameRenderer:
    """Renders frames of a run; `textures` are the ids of those of surfaces, by IRI, `painted` what they show."""

    renderer: Renderer
    model: Any
    textures: Mapping[str, int]
    painted: dict[str, Shades] = field(default_factory=dict)

    def picture(self, frame: Frame, view: CameraView, annotations: Annotations) -> Picture:
        """Return the picture of a frame."""
        for surface, texture in self.textures.items():
            shades = frame.shades[surface]
            if self.painted.get(surface) is not shades:
                self.renderer.paint(texture, colour_surface(shades))
                self.painted[surface] = shades
        return self.renderer.picture(posed(self.model, frame.posture), view, annotations)


def _legend(frame: Frame) -> str:
    return WORKED if any(shades.any() for shades in frame.shades.values()) else ""


def _time(footage: Footage, frame: Frame) -> str:
    return f"{frame.time:.1f} s, film {footage.speed_up} x faster"
