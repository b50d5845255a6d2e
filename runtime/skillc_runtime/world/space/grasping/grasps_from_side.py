"""Grasps from the side: the hand is horizontal with its x upwards, and the fingers close horizontally around a body."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bodies import RigidBody
from skillc_runtime.world.space.grasping.grasp_geometry import (
    APPROACH_M,
    LEAST_HOLD_M,
    SUPPORT_CLEARANCE_M,
    UP,
    GraspCandidate,
    GraspScene,
    horizontal_axes,
    is_round,
    leans,
    solids_between,
    span,
)
from skillc_runtime.world.space.grasping.grip_force import GraspError
from skillc_runtime.world.space.occupants import Occupant, occupant_of

HEIGHT_STEP_M = 0.01
"""The distance of the heights at which a body is tried to be grasped."""

SIDES_RAD = (0.0, 0.8, -0.8)
"""The directions from which a round body is approached, as seen from the arm."""

LEAST_TOWARDS = -0.1
"""The cosine between the direction off the arm and that of an approach is at least this."""


def derive_from_side(scene: GraspScene) -> tuple[GraspCandidate, ...]:
    """Return the grasps from the side, one for each direction of approach; GraspError if there is none."""
    bottom, top = span(scene.body, UP)
    lowest = bottom + scene.hand.half_height_m + SUPPORT_CLEARANCE_M
    highest = top - scene.hand.finger_width_m / 2
    thing, gripper = scene.names
    if lowest > highest:
        raise GraspError(
            f"{thing} is {1e3 * (top - bottom):.0f} mm high as it lies, and {gripper} needs "
            f"{1e3 * (lowest - bottom + scene.hand.finger_width_m / 2):.0f} mm to hold it from the side",
            "lay it down differently, or state a skiros:GraspingPose",
        )
    heights = _heights(lowest, highest, float(scene.body.pose.apply(scene.body.centre)[2]))
    found = (_at_best_height(scene, direction, heights) for direction in _directions(scene.body, scene.away))
    grasps = tuple(each for each in found if each is not None)
    if not grasps:
        raise GraspError(
            f"{gripper} finds no height at which it takes {thing} from the side: it is wider there than the "
            f"{1e3 * scene.takes_m:.0f} mm that the fingers take, or something is in the way",
            f"give {thing} more room, or use a wider gripper",
            "no-room",
        )
    return grasps


def _at_best_height(scene: GraspScene, direction: Array, heights: list[float]) -> GraspCandidate | None:
    around = (*scene.others, occupant_of(scene.body))
    for height_m in heights:
        found = _grasp(scene, direction, height_m)
        if found is None or scene.hand.find_in_the_way(found.tool, found.opening_m, APPROACH_M, around) is not None:
            continue
        return found
    return None


def _grasp(scene: GraspScene, direction: Array, height_m: float) -> GraspCandidate | None:
    """Return the grasp at a height in m along a horizontal direction (3,); None if the body does not fit there."""
    body, hand, closing = scene.body, scene.hand, np.cross(direction, UP)
    held = solids_between(body, UP, height_m - hand.finger_width_m / 2, height_m + hand.finger_width_m / 2)
    if not held:
        return None
    (left, right), (front, back) = span(body, closing, held), span(body, direction, held)
    width_m, deep = right - left, min((front + back) / 2, front + hand.depth_m)
    if width_m > scene.takes_m or deep < front + LEAST_HOLD_M:
        return None
    at = deep * direction + (left + right) / 2 * closing + height_m * UP
    found = scene.with_room(Pose(at, np.column_stack([UP, closing, direction])), width_m)
    return None if isinstance(found, Occupant) else found


def _heights(lowest: float, highest: float, wanted: float) -> list[float]:
    """Return heights in m between two, those near a wanted one first."""
    count = int((highest - lowest) / HEIGHT_STEP_M) + 2
    return sorted(np.linspace(lowest, highest, count).tolist(), key=lambda each: round(abs(each - wanted), 6))


def _directions(body: RigidBody, away: Array) -> Iterator[Array]:
    """Yield the horizontal directions (3,) in which a hand can come, first that which points off the arm most."""
    if is_round(body) and not leans(body):
        across = np.cross(UP, away)
        yield from (np.cos(angle) * away + np.sin(angle) * across for angle in SIDES_RAD)
        return
    axes = horizontal_axes(body, away)[: 1 if is_round(body) else 2]
    sides = [sign * axis for axis in axes for sign in (1.0, -1.0)]
    yield from sorted(
        (each for each in sides if each @ away > LEAST_TOWARDS), key=lambda each: -round(float(each @ away), 6)
    )
