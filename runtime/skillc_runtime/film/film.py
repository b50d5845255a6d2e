"""A film of a run, and stills: frames are sampled during the run, pictures are rendered afterwards."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from skillc_runtime.film.annotations import Annotations
from skillc_runtime.film.camera import CameraView
from skillc_runtime.film.captions import STRIP_PIXELS, Caption, FilmEnding, StripText, caption_at, draw_strip
from skillc_runtime.film.filmed_cell import FilmedCell
from skillc_runtime.film.force_marks import ForceMarks
from skillc_runtime.film.frames import FRAMES_PER_S, Frame, FrameSampler
from skillc_runtime.film.framing import Framing, posed
from skillc_runtime.film.picture_files import FilmError, LoopPictures, write_film, write_picture
from skillc_runtime.film.props import make_props
from skillc_runtime.film.rendering import Picture, Quality, Renderer
from skillc_runtime.film.surface_colours import colour_surface
from skillc_runtime.film.workshop import find_texture, workshop_model
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.frames import size
from skillc_runtime.world.state.terms import ARM_DEVICE, SURFACE

FILM, LOOP = "film.mp4", "film.gif"
WIDTH, HEIGHT = 1280, 720
"""Size of a picture in pixels; a strip with captions is at its bottom."""

END_S = 2.0
"""How long the last picture is shown, with how the run ended."""

WORKED = "lighter: the tool worked there (ground truth of the simulator)"


@dataclass(frozen=True, slots=True)
class Moment:
    """A moment of a run, in s, to show in a still, and the arm, by IRI, that it shows."""

    title: str
    time: float
    arm: str


@dataclass(frozen=True, slots=True)
class Still:
    """A still: its title and the name of its file."""

    title: str
    file: str


@dataclass(frozen=True, slots=True)
class Story:
    """What the film of a run tells besides its pictures: moments for stills, captions, how the run ended."""

    moments: Sequence[Moment] = ()
    captions: Sequence[Caption] = ()
    ending: FilmEnding | None = None


NO_STORY = Story()


@dataclass(frozen=True, slots=True)
class FilmFiles:
    """The names of the written files, a film, stills and a loop; how many times faster the film is than the run."""

    film: str
    stills: tuple[Still, ...]
    speed_up: int
    loop: str | None = None


class Film:
    """Samples frames of a run and renders them, from one camera that frames the work."""

    def __init__(self, cell: FilmedCell, spec: Any | None = None, loop: bool = False) -> None:
        """Film a cell, with a `loop` also as film.gif, a short film that repeats.

        `spec` describes the model to render, with the same joints, if it is not that of the cell.
        """
        self._drawing, self._truth, self._spec = cell.drawing, cell.truth, spec
        self._loop = loop
        self._sampler = FrameSampler(cell)
        self._state = cell.world.snapshot()
        self._arms = sorted(self._state.instances(ARM_DEVICE))
        present = filter(self._truth.is_present, sorted(self._state.instances(SURFACE)))
        self._props = tuple(
            prop for each in present for prop in make_props(self._truth.surface_pose(each), size(self._state, each))
        )

    @property
    def speed_up(self) -> int:
        """How many times faster the film is than the run."""
        return self._sampler.speed_up

    def sample(self) -> None:
        """Sample a frame if one is due."""
        self._sampler.sample()

    def write(self, directory: Path, story: Story = NO_STORY) -> FilmFiles:
        """Render all frames to film.mp4, stills of some moments to PNG, and the loop if it is wanted.

        Each file is written completely or not at all.

        Raises FilmError or RenderingError if that is not possible, OSError if the folder cannot be written to.
        """
        if not self._arms:
            raise FilmError("there is no arm in the scene for a camera to stay with")
        if not self._sampler.frames:
            raise FilmError("the run ended before anything moved")
        model = self._model()
        aspect = WIDTH / (HEIGHT - STRIP_PIXELS)
        framing = Framing(model, self._drawing, self._sampler.frames, dict(self._corners()), aspect)
        shown = LoopPictures()
        pictures = self._pictures(model, framing, story)
        write_film(directory / FILM, shown.keep(pictures) if self._loop else pictures, WIDTH, HEIGHT, FRAMES_PER_S)
        if self._loop:
            shown.write(directory / LOOP)
        names = [f"{number}-{_slug(each.title)}.png" for number, each in enumerate(story.moments, 1)]
        for name, picture in zip(names, self._stills(model, framing, story.moments), strict=True):
            write_picture(directory / name, picture)
        stills = tuple(Still(each.title, name) for each, name in zip(story.moments, names, strict=True))
        return FilmFiles(FILM, stills, self.speed_up, LOOP if self._loop else None)

    def _pictures(self, model: Any, framing: Framing, story: Story) -> Iterator[Picture]:
        """Render the pictures of the film, each (HEIGHT, WIDTH, 3)."""
        frames, high = self._sampler.frames, HEIGHT - STRIP_PIXELS
        marks = ForceMarks(frames, self._truth, self.speed_up)
        views, picture = framing.work_views(), np.empty(0, dtype=np.uint8)
        with self._renderer(model, WIDTH, high, "film") as scene:
            for at, (frame, view) in enumerate(zip(frames, views, strict=True)):
                marked = Annotations(frame.annotations.ghosts, (), marks.arrows(at), marks.trails(at))
                picture = scene.picture(frame, view, marked)
                text = StripText(
                    caption_at(story.captions, frame.time),
                    self._legend(frame),
                    _force_text(marks, at),
                    self._time(frame),
                )
                yield np.concatenate([picture, draw_strip(text, WIDTH)])
        if story.ending is not None:
            text = StripText(story.ending.text, "", "", self._time(frames[-1]), story.ending.kind)
            for _ in range(round(END_S * FRAMES_PER_S)):
                yield np.concatenate([picture, draw_strip(text, WIDTH)])

    def _stills(self, model: Any, framing: Framing, moments: Sequence[Moment]) -> Iterator[Picture]:
        """Render close views of some moments, each (HEIGHT, WIDTH, 3)."""
        if not moments:
            return
        frames = self._sampler.frames
        marks = ForceMarks(frames, self._truth, self.speed_up)
        with self._renderer(model, WIDTH, HEIGHT, "still") as scene:
            for moment in moments:
                since_s = moment.time - frames[0].time
                at = min(round(since_s * FRAMES_PER_S / self.speed_up), len(frames) - 1)
                view = framing.hand_view(at, moment.arm)
                yield scene.picture(frames[at], view, replace(frames[at].annotations, arrows=marks.arrows(at)))

    @contextmanager
    def _renderer(self, model: Any, width: int, height: int, quality: Quality) -> Iterator[FrameRenderer]:
        renderer = Renderer(model, width, height, self._props, quality)
        textures = {each: find_texture(model, self._drawing, each) for each in self._worked()}
        try:
            yield FrameRenderer(renderer, model, textures)
        finally:
            renderer.close()

    def _model(self) -> Any:
        """Return the model to draw; surfaces that were worked on can change their colours."""
        shades = self._sampler.frames[-1].shades
        return workshop_model(self._drawing, self._spec, {each: shades[each].shape for each in self._worked()})

    def _worked(self) -> list[str]:
        return [each for each, shades in self._sampler.frames[-1].shades.items() if shades.any()]

    def _corners(self) -> Iterator[tuple[str, Array]]:
        """Yield each surface that was worked on, by IRI, with its corners (4, 3) in m."""
        for each in self._worked():
            half = size(self._state, each) / 2
            corners = [np.array([x, y, 0.0]) for x, y in product((-half[0], half[0]), (-half[1], half[1]))]
            yield each, np.array([self._truth.surface_pose(each).apply(corner) for corner in corners])

    @staticmethod
    def _legend(frame: Frame) -> str:
        return WORKED if any(shades.any() for shades in frame.shades.values()) else ""

    def _time(self, frame: Frame) -> str:
        return f"{frame.time:.1f} s, film {self.speed_up} x faster"


@dataclass(frozen=True, slots=True)
class FrameRenderer:
    """Renders frames of a run; `textures` are the ids of those of surfaces, by IRI."""

    renderer: Renderer
    model: Any
    textures: Mapping[str, int]

    def picture(self, frame: Frame, view: CameraView, annotations: Annotations) -> Picture:
        """Return the picture of a frame."""
        for surface, texture in self.textures.items():
            self.renderer.paint(texture, colour_surface(frame.shades[surface]))
        return self.renderer.picture(posed(self.model, frame.posture), view, annotations)


def _force_text(marks: ForceMarks, at: int) -> str:
    force = marks.greatest_n(at)
    return "" if force is None else f"presses with {force:.0f} N"


def _slug(title: str) -> str:
    """Return a title as a part of a file's name."""
    return re.sub(r"[^A-Za-z0-9]+", "-", title).strip("-").lower()
