"""Moves an arm to a pose or a posture."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

from skillc_runtime.devices.motion_interface import MotionModel
from skillc_runtime.kinematics.inverse import APART_RAD
from skillc_runtime.motion.paths.path import Path, join_segments, path_through
from skillc_runtime.motion.paths.segments import MotionLimits, segment_between
from skillc_runtime.motion.pose import Array, Pose, exp, log
from skillc_runtime.primitives.arm_motion import ArmMotion
from skillc_runtime.primitives.collision_free_motion import move_collision_free, move_tool_along
from skillc_runtime.primitives.computation import Computing
from skillc_runtime.primitives.known_limits import CORRECTION_M
from skillc_runtime.primitives.primitive import SkillFailure, SpaceLacking
from skillc_runtime.primitives.space_needs import Follow, Reach, SpaceNeed, Take
from skillc_runtime.primitives.touch_guard import RESISTANCE_N
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.labels.labelled import LabelledQuantity, LabelledVector
from skillc_runtime.world.state.terms import HAS_GRIPPER, HAS_POSTURE, HAS_SHEET, IS_TAKEN, PLACING_POSE, POSTURE_NAME

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.world.state.values import Value
    from skillc_runtime.world.state.world_state import WorldState

HOME = "home"

MOST_POSTURES = 8
"""How many postures of a pose are tried, of which the first ones are in collision."""

GENTLE_M_S, GENTLE_M = 0.03, CORRECTION_M + 0.01
"""The greatest speed of a tool, and from how far before the end of a line, where it may touch what is nearer than it is
believed to be."""

OTHER_POSTURE = "takes another posture than was planned, which is not free, or does not bring its tool there"

ABOVE_PLACE_M = 0.02
"""A line that ends nearer than this to a placing pose was to put something there."""

ARRIVED_M = 0.005
"""A tool that touches something nearer than this to the end of its line has arrived: it was to be put there."""

FORWARDS = 0.7
"""The cosine of the greatest angle between the direction in which a tool points and one in which it goes forwards."""


class MoveJoints(ArmMotion):
    """Moves the tool to `target` in joint space at `pace`, a share of the maximum joint speeds.

    The motion avoids the obstacles in the world model, also with what the arm holds.
    """

    ends_free = True

    targets = ("target",)

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return that the tool gets to the target."""
        arm, target = arguments.get("arm"), arguments.get("target")
        return (Reach(arm, target),) if isinstance(arm, str) and isinstance(target, Pose) else None

    def __init__(self, cell: Cell, *, arm: str, target: Pose, pace: float) -> None:
        super().__init__(cell, arm)
        self._individual, self._target, self._pace = arm, target, pace

    def start_motion(self) -> Computing:
        """Find the posture that was planned, else that nearest to home, another where that is not free, and go."""
        home, now = _find_posture(self.cell.world.snapshot(), self._individual, HOME), self.arm.measured
        known = self.planned_postures
        planned = None if known is None else known.find(self._individual, self._target)
        x, y, z = self._target.position.tolist()
        unreachable = SpaceLacking(
            "the arm cannot reach {target:.3f} in this orientation, {far:.2f} from where its tool is",
            target=LabelledVector((x, y, z), "m"),
            far=LabelledQuantity(float(np.linalg.norm(self._target.position - now.pose.position)), "m"),
        )
        goals = _PoseGoal(self._target, home, planned)
        end = yield from move_collision_free(self.cell, self._individual, goals, self._pace, unreachable)
        if known is not None and planned is not None and np.abs(end - planned).max() > APART_RAD:
            known.tell(self._individual, OTHER_POSTURE)


@dataclass(frozen=True, slots=True)
class _PoseGoal:
    """The postures that put the tool at a target in the world: the one near that planned, then those near home.

    home, planned (nv,): rad; the latter None if no posture was planned.
    """

    target: Pose
    home: Array
    planned: Array | None

    def find(self, model: MotionModel) -> Iterator[Array]:
        """Yield them, the best first."""
        as_planned = None if self.planned is None else model.inverse_kinematics(self.target, self.planned)
        if as_planned is not None:
            yield as_planned
        yield from model.rank_postures(self.target, self.home)[:MOST_POSTURES]


@dataclass(frozen=True, slots=True)
class _PostureGoal:
    """One posture (nv,) in rad."""

    q: Array

    def find(self, model: MotionModel) -> Iterator[Array]:
        """Yield it."""
        yield self.q


class TakePosture(ArmMotion):
    """Moves the arm to a posture of its data sheet, around the obstacles in the world model."""

    ends_free = True

    text_names = MappingProxyType({"posture": ("arm", HAS_SHEET, HAS_POSTURE, POSTURE_NAME)})

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return that the arm takes the posture."""
        arm, posture = arguments.get("arm"), arguments.get("posture")
        if not isinstance(arm, str) or not isinstance(posture, str):
            return None
        return (Take(arm, sheet_of(state, arm).posture(posture)),)

    def __init__(self, cell: Cell, *, arm: str, posture: str, pace: float) -> None:
        super().__init__(cell, arm)
        self._individual, self._posture, self._pace = arm, posture, pace

    def start_motion(self) -> Computing:
        """Look up the posture and start the motion."""
        q = _find_posture(self.cell.world.snapshot(), self._individual, self._posture)
        unreachable = SpaceLacking(f"the arm cannot take the posture {self._posture}")
        yield from move_collision_free(self.cell, self._individual, _PostureGoal(q), self._pace, unreachable)


class MoveLinear(ArmMotion):
    """Moves the tool to `target` along a straight line at `speed` m/s, rotating along the path.

    A line forwards ends gently, so that what is nearer than it is believed to be is not hit hard.
    """

    targets = ("target",)

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return that the tool follows the line."""
        arm, target = arguments.get("arm"), arguments.get("target")
        return (Follow(arm, (target,)),) if isinstance(arm, str) and isinstance(target, Pose) else None

    def __init__(self, cell: Cell, *, arm: str, target: Pose, speed: float, resistance: float = RESISTANCE_N) -> None:
        super().__init__(cell, arm, resistance)
        self._individual = arm
        self._target, self._speed = target, speed

    def start_motion(self) -> Computing:
        """Start the line from the stopping pose."""
        limits, motion = self.limits(self._speed), self.arm.motion
        yield from move_tool_along(
            self.cell, self._individual, lambda: _line_between(motion.stopping_pose(), self._target, limits)
        )

    def is_near_end(self) -> bool:
        """Whether the tool is at the end of its line, as exactly as that can be known."""
        return float(np.linalg.norm(self.arm.measured.pose.position - self._target.position)) < ARRIVED_M

    def note_touch(self) -> None:
        """Write as well that placing poses are taken to which something held was to go."""
        super().note_touch()
        state = self.cell.world.snapshot()
        holds = any(self.cell.gripper(each).holding for each in state.objects(self._individual, HAS_GRIPPER))
        taken = [SetProperty(each, IS_TAKEN, True) for each in _placing_poses_at(state, self._target)] if holds else []
        if taken:
            self.cell.world.commit(taken, "MoveLinear", "sensed")


def _placing_poses_at(state: WorldState, target: Pose) -> Iterator[str]:
    """Yield the placing poses that the tool was to reach, or to come down on from a target that close above."""
    for each in sorted(state.instances(PLACING_POSE)):
        with suppress(FrameError):
            if np.linalg.norm(pose(state, each).position - target.position) < ABOVE_PLACE_M:
                yield each


def _line_between(start: Pose, target: Pose, limits: MotionLimits) -> Path:
    """Return the line to a target, in the frame of both; forwards at most with GENTLE_M_S on its last GENTLE_M."""
    way = target.position - start.position
    length = float(np.linalg.norm(way))
    if limits.speed <= GENTLE_M_S or float(way @ target.rotation[:, 2]) <= FORWARDS * length:
        return path_through([start, target], limits)
    gentle, share = replace(limits, speed=GENTLE_M_S), 1.0 - GENTLE_M / length
    if share <= 0.0:
        return path_through([start, target], gentle)
    turn = exp(share * log(target.rotation @ start.rotation.T))
    near = Pose(start.position + share * way, turn @ start.rotation)
    pieces = [segment_between(start, near, limits), segment_between(near, target, gentle)]
    return join_segments([start, near, target], pieces, limits, GENTLE_M)


def _find_posture(state: WorldState, arm: str, name: str) -> Array:
    """Return a posture (nv,) in rad from the data sheet of an arm; SkillFailure lists those that exist."""
    try:
        return sheet_of(state, arm).posture(name)
    except SheetError as error:
        raise SkillFailure(str(error)) from error
