"""Samples the frames of a film while a run goes on; `render_film` makes its pictures afterwards."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

import numpy as np

from skillc_runtime.film.filmed_cell import FilmedCell
from skillc_runtime.film.footage import FILM, LOOP, NO_STORY, FilmFiles, Footage, FrameMarks, Moment, Still, Story
from skillc_runtime.film.force_marks import ForceMarks
from skillc_runtime.film.frames import FrameSampler
from skillc_runtime.film.picture_files import FilmError
from skillc_runtime.film.props import make_props
from skillc_runtime.film.rendering import FilmQuality
from skillc_runtime.film.workshop import find_texture, workshop_model
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.frames import size
from skillc_runtime.world.state.terms import ARM_DEVICE, SURFACE


class FilmSampler:
    """Samples frames of a run."""

    def __init__(
        self, cell: FilmedCell, spec: Any | None = None, loop: bool = False, quality: FilmQuality = "standard"
    ) -> None:
        """Film a cell, with a `loop` also as film.gif, a short film that repeats.

        `spec` describes the model to render, with the same joints, if it is not that of the cell.
        """
        self._drawing, self._truth, self._spec = cell.drawing, cell.truth, spec
        self._loop, self._quality = loop, quality
        self._sampler = FrameSampler(cell)
        self._state = cell.world.snapshot()
        self._arms = sorted(self._state.instances(ARM_DEVICE))
        present = filter(self._truth.is_present, sorted(self._state.instances(SURFACE)))
        self._props = tuple(
            prop for each in present for prop in make_props(self._truth.surface_pose(each), size(self._state, each))
        )

    def sample(self) -> None:
        """Sample a frame if one is due."""
        self._sampler.sample()

    def footage(self, story: Story = NO_STORY) -> Footage:
        """Return what the film of the frames until now is made from. FilmError if there is nothing to show."""
        if not self._arms:
            raise FilmError("there is no arm in the scene for a camera to stay with")
        frames, speed_up = self._sampler.frames, self._sampler.speed_up
        if not frames:
            raise FilmError("the run ended before anything moved")
        model, marks = self._model(), ForceMarks(frames, self._truth, speed_up)
        return Footage(
            model=model,
            prefixes=tuple(self._drawing.prefixes.values()),
            props=self._props,
            textures={each: find_texture(model, self._drawing, each) for each in self._worked()},
            corners=dict(self._corners()),
            frames=frames,
            marks=[FrameMarks(marks.arrows(at), marks.trails(at), marks.greatest_n(at)) for at in range(len(frames))],
            speed_up=speed_up,
            story=story,
            files=FilmFiles(FILM, _name_stills(story.moments), speed_up, LOOP if self._loop else None),
            quality=self._quality,
        )

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


def _name_stills(moments: Sequence[Moment]) -> tuple[Still, ...]:
    return tuple(Still(each.title, f"{number}-{_slug(each.title)}.png") for number, each in enumerate(moments, 1))


def _slug(title: str) -> str:
    """Return a title as a part of a file's name."""
    return re.sub(r"[^A-Za-z0-9]+", "-", title).strip("-").lower()
