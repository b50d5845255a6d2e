"""What a run of a primitive needs of space, as data: where it brings an arm, what it takes, and what it leaves behind.

Poses and directions are in the world, arms and things are IRIs.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from skillc_runtime.motion.pose import Array, Pose


@dataclass(frozen=True, slots=True, eq=False)
class Reach:
    """The arm takes any posture with its tool at a pose, on a way on which it touches nothing."""

    arm: str
    tool: Pose


@dataclass(frozen=True, slots=True, eq=False)
class Take:
    """The arm takes a posture (nv,) in rad, on a way on which it touches nothing."""

    arm: str
    q: Array


@dataclass(frozen=True, slots=True, eq=False)
class Follow:
    """The tool moves along straight lines through poses; it may touch things on its way, links and palm may not."""

    arm: str
    poses: tuple[Pose, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Press:
    """The tool exerts a force (3,) in N from now on, until the scope of the primitive ends."""

    arm: str
    force: Array


@dataclass(frozen=True, slots=True, eq=False)
class Spread:
    """While others move the tool it is also at offsets (n, 3) in m from where they bring it."""

    arm: str
    offsets: Array


@dataclass(frozen=True, slots=True, eq=False)
class Open:
    """The fingers of a gripper are this far apart from now on, in m, or as far as something between them lets them."""

    gripper: str
    opening_m: float


@dataclass(frozen=True, slots=True, eq=False)
class Hold:
    """A gripper holds a thing from now on; `at` is where the hand closed around it."""

    gripper: str
    thing: str
    at: Pose


@dataclass(frozen=True, slots=True, eq=False)
class Leave:
    """What the arm holds stands at a place from now on, where the arm has brought it."""

    arm: str
    gripper: str
    thing: str
    to: str


@dataclass(frozen=True, slots=True, eq=False)
class Stand:
    """A mobile base stands at a workstation from now on: where that wants it to, or nearby where the arm can work."""

    robot: str
    to: str


SpaceNeed: TypeAlias = Reach | Take | Follow | Press | Spread | Open | Hold | Leave | Stand
