"""What a run of a primitive needs of space, as data: where it brings an arm, what it takes, and what it leaves behind.

Poses and directions are in the world, arms and things are IRIs.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import msgspec

from skillc_runtime.motion.pose import Array, Pose


class Reach(msgspec.Struct, frozen=True, eq=False):
    """The arm takes any posture with its tool at a pose, on a way on which it touches nothing."""

    arm: str
    tool: Pose


class PutFlange(msgspec.Struct, frozen=True, eq=False):
    """The arm takes any posture with its flange at one of these poses, the best first, and touches nothing."""

    arm: str
    flanges: tuple[Pose, ...]


class Take(msgspec.Struct, frozen=True, eq=False):
    """The arm takes a posture (nv,) in rad, on a way on which it touches nothing."""

    arm: str
    q: Array


class Follow(msgspec.Struct, frozen=True, eq=False):
    """The tool moves along straight lines through poses; it may touch things on its way, links and palm may not."""

    arm: str
    poses: tuple[Pose, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Press:
    """The tool exerts a force (3,) in N from now on, until the scope of the primitive ends."""

    arm: str
    force: Array


class ToolOffsets(msgspec.Struct, frozen=True, eq=False):
    """While others move the tool it is also at offsets (n, 3) in m from where they bring it."""

    arm: str
    offsets: Array


class Open(msgspec.Struct, frozen=True, eq=False):
    """The fingers of a gripper are this far apart from now on, in m, or as far as something between them lets them."""

    gripper: str
    opening_m: float


class Hold(msgspec.Struct, frozen=True, eq=False):
    """A gripper holds a thing from now on; `at` is where the hand closed around it."""

    gripper: str
    thing: str
    at: Pose


class Leave(msgspec.Struct, frozen=True, eq=False):
    """What the arm holds stands at a place from now on, where the arm has brought it."""

    arm: str
    gripper: str
    thing: str
    to: str


class Stand(msgspec.Struct, frozen=True, eq=False):
    """A mobile base stands at a workstation from now on: where that wants it to, or nearby where the arm can work."""

    robot: str
    to: str


SpaceNeed: TypeAlias = Reach | PutFlange | Take | Follow | Press | ToolOffsets | Open | Hold | Leave | Stand
