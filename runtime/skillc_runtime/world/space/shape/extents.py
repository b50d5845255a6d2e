"""The boxes of objects in their own frames, and where one box touches a face of another."""

from __future__ import annotations

import msgspec

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.state.terms import FURNITURE, MOBILE_ROBOT, SURFACE

FRAME_HEIGHT = {FURNITURE: 0.5, SURFACE: 0.5, MOBILE_ROBOT: -0.5}
"""The position of the frame along z above the middle, as a share of the height; 0 for other classes."""

FACES = {
    "front": (0, 1.0),
    "back": (0, -1.0),
    "left": (1, 1.0),
    "right": (1, -1.0),
    "top": (2, 1.0),
    "bottom": (2, -1.0),
}
"""The axis (0 to 2) and the direction along it in which each face of a box looks."""


class LocalBox(msgspec.Struct, frozen=True, eq=False):
    """The box of an object: half its size (3,) in m, and its middle (3,) in m in the object's frame."""

    half: Array
    middle: Array

    @staticmethod
    def of(half: Array, classes: frozenset[str]) -> LocalBox:
        """Return the box of an object of these classes, superclasses included; `half` (3,) is half its size in m."""
        share = next((share for cls, share in FRAME_HEIGHT.items() if cls in classes), 0.0)
        return LocalBox(half, np.array([0.0, 0.0, -2 * share * half[2]]))


class Spot(msgspec.Struct, frozen=True):
    """A place on a box: the name of a face, whether offsets are from its middle or from its least corner, offsets in m.

    The offsets are along the axes of the box's frame. The least corner has the least coordinates on the face.
    """

    face: str
    from_corner: bool
    offset: tuple[float, float, float]


def contact_pose(carrier: LocalBox, thing: LocalBox, rotation: Array, spot: Spot) -> Pose:
    """Return the pose, in the frame of the carrier, in which a thing touches its box from outside at a spot.

    rotation: of the thing in the frame of the carrier, (3, 3). The middle of the thing's box is over the spot.
    """
    axis, direction = FACES[spot.face]
    start = carrier.middle - carrier.half if spot.from_corner else carrier.middle.copy()
    start[axis] = carrier.middle[axis] + direction * (carrier.half[axis] + np.abs(rotation[axis]) @ thing.half)
    return Pose(start + spot.offset - rotation @ thing.middle, rotation)
