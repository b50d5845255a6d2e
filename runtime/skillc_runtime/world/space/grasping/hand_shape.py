"""The room that the fingers and the palm of a gripper take up around a thing, and what is in their way."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.occupants import HERE, Occupant
from skillc_runtime.world.space.shape.oriented_box import OrientedBox
from skillc_runtime.world.space.shape.solids import Solid
from skillc_runtime.world.state.data_sheet import number_of, sheet_of
from skillc_runtime.world.state.terms import (
    FINGER_DEPTH,
    FINGER_SPREAD,
    FINGER_THICKNESS,
    FINGER_TIP,
    FINGER_WIDTH,
    PALM_THICKNESS,
    PALM_WIDTH,
)
from skillc_runtime.world.state.world_state import WorldState

FINGER_DEPTH_M, FINGER_TIP_M = 0.03, 0.01
"""How much of the fingers is free above and below the tool centre point, unless the data sheet says it."""

FINGER_WIDTH_M, FINGER_THICKNESS_M = 0.04, 0.02
PALM_WIDTH_M, PALM_THICKNESS_M = 0.15, 0.06
"""The size of fingers and palm across and along the direction in which they close, unless the data sheet says it."""

RELEASE_CLEARANCES_M = (0.04, 0.016, 0.008)
"""How much farther than the object's width fingers open to release it, and where there is less room."""

SLACK_M = 0.001
"""How deep things may overlap that are known to touch."""


class HandShape(msgspec.Struct, frozen=True):
    """A gripper around its tool centre point, in m: it points along z, and its fingers close along y.

    depth_m: from the tool centre point to the palm; tip_m: to the tips. finger_width_m, palm_thickness_m: along x;
    finger_thickness_m, palm_width_m: along y. spread_m: the gap between two fingers on one side, along x.
    """

    widest_m: float
    depth_m: float
    tip_m: float
    spread_m: float
    finger_width_m: float
    finger_thickness_m: float
    palm_width_m: float
    palm_thickness_m: float

    @property
    def half_height_m(self) -> float:
        """Half of how high the hand is when it is horizontal and its fingers close horizontally."""
        return max(self.finger_width_m, self.palm_thickness_m) / 2

    def boxes(self, tool: Pose, opening_m: float, before_m: float) -> Iterator[OrientedBox]:
        """Yield the room of palm and open fingers that come to a pose.

        Of the fingers it is wider by what things may overlap: beside them nothing is known to touch.
        tool: pose in the world.
        opening_m: m, between the fingers.
        before_m: m, how far before the pose they come from.
        """
        palm, finger = np.array([self.palm_thickness_m, self.palm_width_m]) / 2, self.finger_width_m / 2 + SLACK_M
        yield _box(tool, (-palm[0], -palm[1], -self.depth_m - before_m), (palm[0], palm[1], -self.depth_m))
        near, far = opening_m / 2, opening_m / 2 + self.finger_thickness_m + SLACK_M
        for low, high in ((-far, -near), (near, far)):
            yield _box(tool, (-finger, low, -self.depth_m - before_m), (finger, high, self.tip_m))

    def find_in_the_way(
        self, tool: Pose, opening_m: float, before_m: float, others: Iterable[Occupant]
    ) -> Occupant | None:
        """Return the first of others that the hand overlaps on its way to a pose; None without one.

        tool: pose in the world.
        opening_m: m, between the fingers.
        before_m: m, how far before the pose it comes from.
        """
        parts = self.boxes(tool, opening_m, before_m)
        boxes = [(box, box.corners.min(axis=0), box.corners.max(axis=0)) for box in parts]
        for other in others:
            for box, low, high in boxes:
                if (low < other.high).all() and (high > other.low).all() and overlaps(box, other.solids):
                    return other
        return None


def read_hand_shape(state: WorldState, gripper: str) -> HandShape:
    """Return the shape of a gripper from its data sheet; SheetError without one."""
    sheet = sheet_of(state, gripper)

    def stated(name: str, default: float) -> float:
        return number_of(state, sheet.individual, name, default=default)

    return HandShape(
        widest_m=sheet.number("maxOpening"),
        depth_m=stated(FINGER_DEPTH, FINGER_DEPTH_M),
        tip_m=stated(FINGER_TIP, FINGER_TIP_M),
        spread_m=stated(FINGER_SPREAD, 0.0),
        finger_width_m=stated(FINGER_WIDTH, FINGER_WIDTH_M),
        finger_thickness_m=stated(FINGER_THICKNESS, FINGER_THICKNESS_M),
        palm_width_m=stated(PALM_WIDTH, PALM_WIDTH_M),
        palm_thickness_m=stated(PALM_THICKNESS, PALM_THICKNESS_M),
    )


def overlaps(box: OrientedBox, solids: Iterable[Solid]) -> bool:
    """Whether a box overlaps with one of some solids, in the world, as far as their axes separate them."""
    return any(not _are_separated(box, solid) for solid in solids)


def _are_separated(box: OrientedBox, solid: Solid) -> bool:
    for axis in (*box.middle.rotation.T, *solid.place.rotation.T):
        middle, half = float(axis @ box.middle.position), float(np.abs(axis @ box.middle.rotation) @ box.half)
        low, high = -solid.reach(-axis, HERE), solid.reach(axis, HERE)
        if low > middle + half - SLACK_M or high < middle - half + SLACK_M:
            return True
    return False


def _box(tool: Pose, low: tuple[float, ...], high: tuple[float, ...]) -> OrientedBox:
    one, other = np.array(low), np.array(high)
    middle: Array = (one + other) / 2
    return OrientedBox.of(tool @ Pose(middle, np.eye(3)), (other - one) / 2)
