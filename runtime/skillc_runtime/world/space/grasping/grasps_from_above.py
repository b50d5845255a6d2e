"""Grasps from above: the hand points down, and the fingers close across the body in one of two directions."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bodies import RigidBody
from skillc_runtime.world.space.grasping.grasp_geometry import (
    LEAST_HOLD_M,
    SUPPORT_CLEARANCE_M,
    UP,
    GraspCandidate,
    GraspScene,
    horizontal_axes,
    is_round,
    span,
)
from skillc_runtime.world.space.grasping.grip_force import GraspError
from skillc_runtime.world.space.occupants import Occupant
from skillc_runtime.world.space.overhead import HAND_ABOVE_M, roof_problem
from skillc_runtime.world.state.terms import GRASP_WIDTH

HIGHER_M = 0.003
"""How much higher a grasp by the top is at least."""


def derive_from_above(scene: GraspScene) -> tuple[GraspCandidate, ...]:
    """Return the grasps from above, that of the narrower side first; GraspError if there is none."""
    return _derive_at(scene, _tool_height(scene))


def derive_by_top(scene: GraspScene) -> tuple[GraspCandidate, ...]:
    """Return those with which only the tips of the fingers hold the body, by its top; none if no other are so high.

    Then there is room beside what is lower, such as in a narrow container. GraspError if there is none from above.
    """
    height_m = span(scene.body, UP)[1] - scene.hand.tip_m / 2
    return _derive_at(scene, height_m) if height_m > _tool_height(scene) + HIGHER_M else ()


def _derive_at(scene: GraspScene, height_m: float) -> tuple[GraspCandidate, ...]:
    """Return the grasps from above with the tool centre point at a height in m in the world."""
    _check_spread(scene)
    spans = [(closing, *span(scene.body, closing)) for closing in _closings(scene.body, scene.away)]
    widths = [high - low for _, low, high in spans]
    if min(widths) > scene.takes_m:
        raise scene.width_error(widths)
    _check_roof(scene, height_m)
    tried = list(_tried(scene, spans, height_m))
    found = [each for each in tried if isinstance(each, GraspCandidate)]
    if not found:
        (thing, gripper), short = scene.names, scene.state.vocabulary.short
        blocker = next(short(each.individual) for each in tried if isinstance(each, Occupant))
        raise GraspError(
            f"{blocker} is in the way of {gripper} around {thing}", f"move it, or give {thing} more room", "no-room"
        )
    return tuple(sorted(found, key=lambda each: round(each.width_m, 3)))


def _tried(
    scene: GraspScene, spans: list[tuple[Array, float, float]], height_m: float
) -> Iterator[GraspCandidate | Occupant]:
    """Yield a grasp for each direction in which the body is narrow enough, or what is in its way."""
    stated = scene.state.value(scene.body.individual, GRASP_WIDTH)
    for index, (closing, low, high) in enumerate(spans):
        if high - low <= scene.takes_m:
            width_m = float(stated) if isinstance(stated, float) and index == 0 else high - low
            yield scene.with_room(Pose(_middle(scene.body, height_m), _hand(closing, scene.away)), width_m)


def _check_spread(scene: GraspScene) -> None:
    """GraspError if a round body slips between two fingers that are apart."""
    (thing, gripper), spread_m = scene.names, scene.hand.spread_m
    if is_round(scene.body) and scene.body.size[0] <= spread_m:
        raise GraspError(
            f"{thing} has a diameter of {1e3 * scene.body.size[0]:.0f} mm and slips between the fingers of {gripper}, "
            f"which are {1e3 * spread_m:.0f} mm apart",
            "use a gripper whose fingers meet",
        )


def _check_roof(scene: GraspScene, height_m: float) -> None:
    """GraspError if there is no room for the arm above a hand whose tool centre point is at a height in m."""
    roof = roof_problem(scene.state, _middle(scene.body, height_m), HAND_ABOVE_M)
    if roof is not None:
        thing, gripper = scene.names
        raise GraspError(f"where {gripper} would grasp {thing}, {roof}", "put it where nothing is above it")


def _tool_height(scene: GraspScene) -> float:
    """Return the height in m of the tool centre point: the middle of the body, or as deep as the fingers reach."""
    over_m = scene.hand.tip_m + SUPPORT_CLEARANCE_M
    bottom, top = span(scene.body, UP)
    height_m = max((bottom + top) / 2, top - scene.hand.depth_m, bottom + over_m)
    if height_m > top - LEAST_HOLD_M:
        thing, gripper = scene.names
        raise GraspError(
            f"{thing} is {1e3 * (top - bottom):.0f} mm high as it lies, and the fingers of "
            f"{gripper} need {1e3 * (over_m + LEAST_HOLD_M):.0f} mm to hold it from above",
            "lay it down differently, or state a skiros:GraspingPose",
        )
    return height_m


def _middle(body: RigidBody, height_m: float) -> Array:
    """Return the point (3,) in m, in the world, over or in the middle of a body at a height in m."""
    x, y = (sum(span(body, axis)) / 2 for axis in np.eye(3)[:2])
    return np.array([x, y, height_m])


def _closings(body: RigidBody, away: Array) -> tuple[Array, Array]:
    """Return two horizontal directions (3,) across a body in which fingers can close, first that across `away`."""
    along, across = horizontal_axes(body, away)
    return (across, along) if abs(along @ away) >= abs(across @ away) else (along, across)


def _hand(closing: Array, away: Array) -> Array:
    """Return the rotation (3, 3) of a hand that points down and closes along a direction; x points off the arm."""
    x = np.cross(closing, -UP)
    x = x if x @ away >= 0 else -x
    return np.column_stack([x, np.cross(-UP, x), -UP])
