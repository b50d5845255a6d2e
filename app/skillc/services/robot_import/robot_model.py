"""What is read of an arm: a chain of links, each moved by one joint, with inertia and simple shapes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from skillc_runtime.motion.pose import Array, Pose

WHOLE_TURN = 2 * np.pi
"""The range to either side of a joint without end, in rad."""

ShapeKind: TypeAlias = Literal["box", "cylinder", "capsule", "sphere"]


@dataclass(frozen=True, slots=True, eq=False)
class Inertia:
    """Mass kg, centre of mass (3,) m and inertia (3, 3) kg m^2 about it, both along the axes of the link's frame."""

    mass_kg: float
    centre: Array
    matrix: Array


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """A simple shape at a pose in the frame of its link, its long axis along z.

    size, in m: the half edges of a box; radius and half length of a cylinder or capsule, without the caps; a radius.
    """

    kind: ShapeKind
    pose: Pose
    size: tuple[float, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Joint:
    """A joint at the origin of its link's frame; a joint that slides has m, N and m/s in place of rad, N m and rad/s.

    axis (3,): unit vector in the link's frame; effort and speed are None if the file does not state them.
    """

    name: str
    slides: bool
    axis: Array
    low: float
    high: float
    effort: float | None
    speed: float | None


@dataclass(frozen=True, slots=True, eq=False)
class RobotLink:
    """A link with all that is fixed to it; `placement` is its frame in that of the link before, at joint position 0."""

    name: str
    placement: Pose
    joint: Joint
    inertia: Inertia
    shapes: tuple[Shape, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Base:
    """The part that does not move; its frame is the base of the arm. Its mass does not matter."""

    name: str
    shapes: tuple[Shape, ...]


@dataclass(frozen=True, slots=True, eq=False)
class RobotModel:
    """An arm: base and moving links from the base on; `flange` is where a gripper is mounted, in the last link's frame.

    `tip` is the name of the flange in the file; `armature` is the rotor inertia in kg m^2 that the file states.
    """

    base: Base
    links: tuple[RobotLink, ...]
    flange: Pose
    tip: str
    armature: float | None = None
