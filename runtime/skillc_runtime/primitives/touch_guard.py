"""Stops an arm that meets something on its way, and says at which height and what is believed to be there."""

from __future__ import annotations

from contextlib import suppress
from math import hypot
from typing import TYPE_CHECKING, Final

import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.primitives.primitive import SkillFailure, SpaceLacking
from skillc_runtime.primitives.touched_obstacles import note_obstacle
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import size
from skillc_runtime.world.space.grasping.hand_shape import read_hand_shape
from skillc_runtime.world.space.occupants import read_occupants
from skillc_runtime.world.space.shape.oriented_box import CORNERS
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.labels.labelled import LabelledQuantity, LabelledValue
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import HAS_GRIPPER, TOUCHED_OBSTACLE

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.world.state.world_state import WorldState

RESISTANCE_N: Final = 15.0
"""The greatest force against a motion unless it is stated: more than arms feel by mistake, from noise or a wrong weight
of what they hold."""

MOVING_M_S: Final = 0.001
"""A slower reference has no direction."""

UPWARDS: Final = 0.7
"""The height of a direction, 1 for straight up, from which on a weight resists a motion."""

KNOWN_M: Final = 0.05
"""How far what is touched may be from where something is believed to be for that to be named."""


class TouchGuard:
    """Watches that nothing resists the motions of an arm with more than `limit_n`, unless it yields along an axis.

    An arm feels it with a force sensor or by the torques of its joints. Without either it feels it by the deviation
    from its reference, while it is led along lines.
    """

    def __init__(self, cell: Cell, arm: str, limit_n: float) -> None:
        self._cell, self._individual, self._arm, self._limit_n = cell, arm, cell.arm(arm), limit_n
        self._way: Array = np.zeros(3)
        self._unknown: Array | None = None

    def find_touch(self) -> SkillFailure | None:
        """Stop the arm if something resists, and return what is touched; else None."""
        velocity = self._arm.motion.path_velocity
        speed = hypot(*velocity.tolist())
        if speed > MOVING_M_S:
            self._way = velocity / speed
        touch = self.feel_touch()
        if touch is not None:
            self._hold_here()
        return touch

    def feel_touch(self) -> SkillFailure | None:
        """Return what is touched if something resists on the way last taken; the arm is left as it is."""
        if self._arm.compliance.released:
            return None
        force = self._arm.measured.wrench[:3].copy()
        resistance_n = -float(force @ self._way)
        return self._describe(resistance_n, -force / np.linalg.norm(force)) if resistance_n > self._limit_n else None

    def note_unknown(self, origin: str) -> None:
        """Write to the world model what was touched if nothing is known to be there."""
        if self._unknown is not None:
            note_obstacle(self._cell, self._individual, self._unknown, origin)

    def _hold_here(self) -> None:
        """Hold the tool where it is along its way, so that it does not press on what it touches."""
        self._arm.motion.stop()
        self._arm.compliance.release(self._way)
        self._arm.compliance.restore()

    def _describe(self, resistance_n: float, into: Array) -> SkillFailure:
        """Return the failure of a motion that something resists in the direction `into`, a unit vector (3,)."""
        state = self._cell.world.snapshot()
        words = state.vocabulary
        thing = next(filter(None, (self._cell.gripper(each).holding for each in self._grippers)), None)
        points = self._tips if thing is None else find_corners(state, thing, self._arm.measured.pose)
        ahead = points @ self._way
        height_m = float(points[ahead > ahead.max() - KNOWN_M / 10][:, 2].mean())
        named: dict[str, LabelledValue] = {}
        nearest, far_m = find_nearest(state, points)
        if far_m > KNOWN_M:
            there = "nothing is known to be there"
        else:
            there, named = "{other} is believed to be {far:.0f mm} from there", {"other": label(nearest, words)}
        may_weigh = thing is not None and self._way[2] > UPWARDS
        if may_weigh:
            there += ", or it weighs more than is known"
        elif far_m > KNOWN_M or state.is_a(nearest, TOUCHED_OBSTACLE):
            self._unknown = into
        failure = SkillFailure if may_weigh else SpaceLacking
        return failure(
            "{touching} touches something at a height of {height:.3f} and meets {force:.0f}: " + there,
            touching=label(thing or next(iter(self._grippers), self._individual), words),
            height=LabelledQuantity(height_m, "m"),
            force=LabelledQuantity(resistance_n, "N"),
            far=LabelledQuantity(far_m, "m"),
            **named,
        )

    @property
    def _grippers(self) -> list[str]:
        return sorted(self._cell.world.snapshot().objects(self._individual, HAS_GRIPPER))

    @property
    def _tips(self) -> Array:
        """The tool centre point and the tips of open fingers (n, 3) in m in the world."""
        tool = self._arm.measured.pose
        points = [tool.position]
        for each in self._grippers:
            with suppress(SheetError):
                tip_m = read_hand_shape(self._cell.world.snapshot(), each).tip_m
                half_m = self._cell.gripper(each).opening_m / 2
                points += [tool.apply(np.array([0.0, side * half_m, tip_m])) for side in (-1.0, 1.0)]
        return np.array(points)


def find_corners(state: WorldState, thing: str, tool: Pose) -> Array:
    """Return the corners (8, 3) in m in the world of the box of what is held; the tool's point without a size.

    tool: the tool centre point in the world.
    """
    try:
        extent = size(state, thing)
    except FrameError:
        return tool.position[None, :]
    held = tool @ working_face(extent).inverse()
    corners: Array = CORNERS * extent / 2 @ held.rotation.T + held.position
    return corners


def find_nearest(state: WorldState, points: Array) -> tuple[str, float]:
    """Return what is believed to be nearest to one of points (n, 3) in m in the world, and how far it is, in m."""
    found = [(box.distance(points), each.individual) for each in read_occupants(state) for box in each.boxes]
    far_m, nearest = min(found, default=(np.inf, ""))
    return nearest, float(far_m)
