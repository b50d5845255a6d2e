"""What pictures show besides the simulation: names, arrows, trails, and ghosts where things are only believed to be."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from skillc_runtime.film.filmed_cell import FilmedCell
from skillc_runtime.film.props import Prop
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bodies import RigidBody, read_bodies
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.labels.labelled import display_name
from skillc_runtime.world.state.terms import CONTAINER

ELSEWHERE_M = 0.005
"""There is a ghost if a thing is believed to be farther than this from where it is."""

GHOST_RGBA = (0.1, 0.75, 0.95, 0.45)

ABOVE_M = 0.012
"""Distance of a name above the thing."""


@dataclass(frozen=True, slots=True)
class NameTag:
    """A text at a point (3,) in m of the world."""

    text: str
    point: Array


@dataclass(frozen=True, slots=True)
class ForceArrow:
    """An arrow between two points (3,) in m of the world, in the direction of a force, and its label."""

    tail: Array
    tip: Array
    text: str


@dataclass(frozen=True, slots=True)
class Annotations:
    """The ghosts and names of one frame, arrows of forces, and trails: points (n, 3) in m of the world."""

    ghosts: tuple[Prop, ...] = ()
    tags: tuple[NameTag, ...] = ()
    arrows: tuple[ForceArrow, ...] = ()
    trails: tuple[Array, ...] = ()


NO_ANNOTATIONS = Annotations()


class SceneAnnotator:
    """Makes the annotations of each frame: ghosts of what a skill can move, names of that and of containers."""

    def __init__(self, cell: FilmedCell) -> None:
        self._world, self._truth = cell.world, cell.truth
        state = self._world.snapshot()
        bodies = read_bodies(state)
        self._movable = tuple(each for each in bodies if each.movable)
        self._fixed = tuple(
            _name_tag(each, each.pose) for each in bodies if not each.movable and state.is_a(each.individual, CONTAINER)
        )

    def sample(self) -> Annotations:
        """Return the annotations of the present instant."""
        state = self._world.snapshot()
        ghosts, tags = list[Prop](), list(self._fixed)
        for body in self._movable:
            really = self._truth.body_pose(body.individual)
            tags.append(_name_tag(body, really))
            with suppress(FrameError):
                believed = pose(state, body.individual)
                if np.linalg.norm(believed.position - really.position) > ELSEWHERE_M:
                    ghosts += _ghost(body, believed)
        return Annotations(tuple(ghosts), tuple(tags))


def _ghost(body: RigidBody, at: Pose) -> Iterator[Prop]:
    for solid in body.solids:
        yield Prop(at @ solid.place, 2.0 * np.array(solid.half), GHOST_RGBA, solid.kind)


def _name_tag(body: RigidBody, at: Pose) -> NameTag:
    above = float(np.abs(at.rotation[2]) @ body.size) / 2 + ABOVE_M
    return NameTag(display_name(body.individual), at.position + np.array([0.0, 0.0, above]))
