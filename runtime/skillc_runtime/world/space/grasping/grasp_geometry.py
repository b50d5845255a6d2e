"""What grasps are derived from: a body, the hand that takes it, and what is around them."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bodies import RigidBody
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.grasping.grip_force import GraspError
from skillc_runtime.world.space.grasping.hand_shape import HandShape
from skillc_runtime.world.space.occupants import Occupant
from skillc_runtime.world.space.shape.shapes import Capsule, Cylinder, Sphere
from skillc_runtime.world.space.shape.solids import Solid
from skillc_runtime.world.state.terms import HAS_GRIPPER
from skillc_runtime.world.state.world_state import WorldState

UP = np.array([0.0, 0.0, 1.0])

APPROACH_M = 0.12
"""How far before a grasp a hand approaches in a line."""

OPENING_CLEARANCES_M = (0.04, 0.016)
"""How much farther than an object is wide the fingers open around it, if they can, and where there is less room."""

LEAST_CLEARANCE_M = 0.006
"""How much farther than an object is wide the fingers must open at least."""

SUPPORT_CLEARANCE_M = 0.004
"""How far a hand stays above what an object stands on."""

LEAST_HOLD_M = 0.002
"""How far an object must stand out before the tool centre point."""

SIDEWAYS = 0.5
"""The cosine of the angle between a hand and the vertical below which it counts as horizontal."""

STANDING = 0.7
"""The cosine of the tilt up to which a round thing counts as standing."""


UPRIGHT = 0.02
"""The sine of the tilt up to which a standing round thing counts as upright."""


class GraspCandidate(msgspec.Struct, frozen=True, eq=False):
    """Where the tool centre point is in the world, how wide the thing is there and how far the fingers open, in m."""

    tool: Pose
    width_m: float
    opening_m: float


class GraspScene(msgspec.Struct, frozen=True, eq=False):
    """A body to grasp, the hand, the direction (3,) in the world from the arm to the body, and what is around."""

    state: WorldState
    gripper: str
    body: RigidBody
    hand: HandShape
    away: Array
    others: tuple[Occupant, ...]

    @property
    def names(self) -> tuple[str, str]:
        """The short names of the body and the gripper."""
        return self.state.vocabulary.short(self.body.individual), self.state.vocabulary.short(self.gripper)

    @property
    def takes_m(self) -> float:
        """The greatest width in m that the fingers take."""
        return self.hand.widest_m - LEAST_CLEARANCE_M

    def with_room(self, tool: Pose, width_m: float) -> GraspCandidate | Occupant:
        """Return a grasp whose fingers open as far as they have room for, or what is in the way of the hand.

        tool: pose in the world; width_m: m, of the body between the fingers.
        """
        blocker: Occupant | None = None
        for clearance_m in OPENING_CLEARANCES_M:
            opening_m = min(width_m + clearance_m, self.hand.widest_m)
            blocker = self.hand.find_in_the_way(tool, opening_m, APPROACH_M, self.others)
            if blocker is None:
                return GraspCandidate(tool, width_m, opening_m)
        assert blocker is not None
        return blocker

    def width_error(self, widths: Iterable[float]) -> GraspError:
        """Return that a body is too wide for the fingers, with its widths in m."""
        (thing, gripper), widest = self.names, self.hand.widest_m
        return too_wide(thing, gripper, widths, widest)


def too_wide(thing: str, gripper: str, widths: Iterable[float], widest: float) -> GraspError:
    """Return that a thing of some widths in m is too wide for fingers that open to `widest` m."""
    each = " and ".join(dict.fromkeys(f"{1e3 * width:.0f}" for width in widths))
    return GraspError(
        f"{thing} is {each} mm wide between the fingers, and {gripper} takes at most "
        f"{1e3 * (widest - LEAST_CLEARANCE_M):.0f} mm: it opens to {1e3 * widest:.0f} mm",
        "use a wider gripper, lay it down differently, or state `skillc:graspWidth` where it is narrower",
        "too-wide",
    )


def span(body: RigidBody, direction: Array, solids: tuple[Solid, ...] | None = None) -> tuple[float, float]:
    """Return where a body, or some of its solids, begins and ends along `direction`, a unit vector (3,) in the world.

    In m from the origin of the world.
    """
    pieces = body.solids if solids is None else solids
    low = min(-each.reach(-direction, body.pose) for each in pieces)
    return low, max(each.reach(direction, body.pose) for each in pieces)


def solids_between(body: RigidBody, direction: Array, low: float, high: float) -> tuple[Solid, ...]:
    """Return the solids of a body that reach between two planes across a direction.

    direction: (3,), a unit vector in the world.
    low: m, the distance of the first plane from the origin of the world.
    high: m, the distance of the second one.
    """
    return tuple(
        each
        for each in body.solids
        if each.reach(direction, body.pose) > low and -each.reach(-direction, body.pose) < high
    )


def is_round(body: RigidBody) -> bool:
    """Whether a body is round, seen from above."""
    standing = abs(float(body.pose.rotation[2, 2])) > STANDING
    return isinstance(body.shape, Sphere) or (standing and isinstance(body.shape, Cylinder | Capsule))


def leans(body: RigidBody) -> bool:
    """Whether a round body is tilted: across its axis alone it is as wide at all heights as it is thick."""
    return not isinstance(body.shape, Sphere) and float(np.hypot(*body.pose.rotation[:2, 2])) > UPRIGHT


def is_sideways(tool: Pose) -> bool:
    """Whether a hand with the pose `tool` in the world counts as horizontal."""
    return abs(float(tool.rotation[2, 2])) < SIDEWAYS


def away_from_arm(state: WorldState, gripper: str, point: Array) -> Array:
    """Return the horizontal direction (3,) from the base of the arm to a point (3,) in the world."""
    arm = min(state.subjects(HAS_GRIPPER, gripper), default=None)
    away = np.array([1.0, 0.0, 0.0]) if arm is None else point - pose(state, arm).position
    away[2] = 0.0
    distance = float(np.linalg.norm(away))
    return away / distance if distance > 1e-6 else np.array([1.0, 0.0, 0.0])


def horizontal_axes(body: RigidBody, away: Array) -> tuple[Array, Array]:
    """Return the two horizontal directions (3,) in the world along and across a body, as seen from above.

    away (3,): the unit vector in the world from the arm to the body.
    """
    axes = body.pose.rotation
    if is_round(body) and not leans(body):
        along = away
    elif isinstance(body.shape, Cylinder | Capsule):
        along = axes[:, 2]
    else:
        along = axes[:, int(np.argmin(np.abs(axes[2])))]
    along = np.array([along[0], along[1], 0.0]) / np.hypot(along[0], along[1])
    return along, np.cross(UP, along)
