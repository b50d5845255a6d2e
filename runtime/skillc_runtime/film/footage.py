"""What a film is made from, once its run has ended: values alone, so that another process can make it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from skillc_runtime.film.annotations import ForceArrow
from skillc_runtime.film.captions import Caption, FilmEnding
from skillc_runtime.film.frames import Frame
from skillc_runtime.film.props import Prop
from skillc_runtime.film.rendering import FilmQuality
from skillc_runtime.motion.pose import Array

FILM, LOOP = "film.mp4", "film.gif"


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


@dataclass(frozen=True, slots=True)
class FrameMarks:
    """The arrows of forces in a frame, trails (n, 3) in m of the world, the greatest force in N if one presses."""

    arrows: tuple[ForceArrow, ...]
    trails: tuple[Array, ...]
    greatest_n: float | None


@dataclass(frozen=True, slots=True)
class Footage:
    """The frames of a run with their marks, and what they are drawn with.

    `model` is the `mujoco.MjModel` to draw, `textures` the ids in it of those of surfaces that were worked on, and
    `corners` (4, 3) in m of these, by IRI; `prefixes` begin the names of the parts of each arm and gripper.
    """

    model: Any
    prefixes: tuple[str, ...]
    props: tuple[Prop, ...]
    textures: Mapping[str, int]
    corners: Mapping[str, Array]
    frames: Sequence[Frame]
    marks: Sequence[FrameMarks]
    speed_up: int
    story: Story
    files: FilmFiles
    quality: FilmQuality
