"""Grasps of a body, derived from its shape, its pose, what is around it, and the gripper; a stated one counts.

A hand points along z of its frame, and its fingers close along y. The tool centre point lies between the pads.
"""

from __future__ import annotations

from contextlib import suppress
from functools import lru_cache
from typing import Final, Literal, TypeAlias

from msgspec.structs import replace

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.bodies import RigidBody, read_body
from skillc_runtime.world.space.frame_tree import Unplaced
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.grasping.grasp_geometry import (
    APPROACH_M,
    LEAST_CLEARANCE_M,
    OPENING_CLEARANCES_M,
    UP,
    GraspCandidate,
    GraspScene,
    away_from_arm,
    is_round,
    solids_between,
    span,
    too_wide,
)
from skillc_runtime.world.space.grasping.grasps_from_above import derive_by_top, derive_from_above
from skillc_runtime.world.space.grasping.grasps_from_side import derive_from_side
from skillc_runtime.world.space.grasping.grip_force import GraspError, NoOtherWay, check_weight
from skillc_runtime.world.space.grasping.hand_shape import HandShape, overlaps, read_hand_shape
from skillc_runtime.world.space.occupants import occupant_of, read_occupants
from skillc_runtime.world.space.shape.shapes import Sphere
from skillc_runtime.world.space.shape.solids import Solid
from skillc_runtime.world.state.data_sheet import sheet_of
from skillc_runtime.world.state.terms import FIXTURE, GRASP_WIDTH, GRASPING_POSE, HAS_A
from skillc_runtime.world.state.world_state import WorldState

Way: TypeAlias = Literal["above", "across", "side", "top"]
"""From above with the fingers across the narrower side, from above across the other side, from the side, by its top."""

WAYS: Final[tuple[Way, ...]] = ("above", "across", "side", "top")

ALONG_AXIS = 0.9
"""The cosine up to which two axes count as parallel."""


@lru_cache(maxsize=16)
def find_grasp(state: WorldState, gripper: str, thing: str, way: str) -> GraspCandidate:
    """Return the grasp in a way, of `WAYS`; a stated GraspingPose is the only one, "above".

    GraspError if there is none; FrameError, MissingFact or SheetError if facts are missing.
    """
    stated = stated_pose(state, thing, GRASPING_POSE)
    if stated is not None and way == WAYS[0]:
        return _stated(state, gripper, thing, stated)
    found = () if stated is not None else _derive(_read_scene(state, gripper, thing), way)
    if not found:
        short = state.vocabulary.short
        raise NoOtherWay(f"{short(gripper)} has no other way to grasp {short(thing)}")
    return found[0]


def find_grasps(state: WorldState, gripper: str, thing: str) -> tuple[GraspCandidate, ...]:
    """Return the grasps of the best way, where everything that can be moved is left out; errors as of `find_grasp`."""
    stated = stated_pose(state, thing, GRASPING_POSE)
    if stated is not None:
        return (_stated(state, gripper, thing, stated),)
    return _derive_any(_read_scene(state, gripper, thing, with_movable=False))


def stated_pose(state: WorldState, thing: str, cls: str) -> str | None:
    """Return the pose of a class that a thing states; the first by IRI of several, None without one."""
    return min((each for each in state.objects(thing, HAS_A) if state.is_a(each, cls)), default=None)


def grasp_problem(state: WorldState, gripper: str, thing: str) -> GraspError | None:
    """Return why a gripper cannot grasp a thing as it lies; None if it can. Other errors as of `find_grasp`.

    Of a thing whose pose is not known, as an arm carries it, only the weight counts.
    """
    try:
        check_weight(state, gripper, thing)
        with suppress(Unplaced):
            find_grasps(state, gripper, thing)
    except GraspError as error:
        return error
    return None


def leaves_room(state: WorldState, gripper: str, thing: str, other: str) -> bool | None:
    """Return whether a gripper that can grasp a thing beside all that is fixed can, too, with another thing there.

    None if it cannot grasp it anyway. FrameError, MissingFact or SheetError if facts are missing.
    """
    occupant = tuple(each for each in read_occupants(state) if each.individual == other)
    try:
        found = find_grasps(state, gripper, thing)
        if stated_pose(state, thing, GRASPING_POSE) is not None:
            hand = read_hand_shape(state, gripper)
            return any(hand.find_in_the_way(each.tool, each.opening_m, APPROACH_M, occupant) is None for each in found)
    except GraspError:
        return None
    scene = _read_scene(state, gripper, thing, with_movable=False)
    with suppress(GraspError):
        return bool(_derive_any(replace(scene, others=(*scene.others, *occupant))))
    return False


def width_between(state: WorldState, gripper: str, thing: str, tool: Pose) -> float | None:
    """Return how wide a thing is between the fingers of a hand, in m; None if nothing says so.

    Two fingers that are apart meet a round thing beside its middle. tool: pose of the hand in the world.
    """
    stated = state.value(thing, GRASP_WIDTH)
    if isinstance(stated, float):
        return stated
    body = read_body(state, thing)
    if body is None:
        return None
    hand = read_hand_shape(state, gripper)
    low, high = span(body, tool.rotation[:, 1], _held_solids(body, hand, tool))
    half_m, beside_m = (high - low) / 2, hand.spread_m / 2
    along_axis = abs(float(tool.rotation[:, 0] @ UP)) > ALONG_AXIS and not isinstance(body.shape, Sphere)
    if not is_round(body) or along_axis or beside_m >= half_m:
        return high - low
    return half_m + float(np.sqrt(half_m**2 - beside_m**2))


def _held_solids(body: RigidBody, hand: HandShape, tool: Pose) -> tuple[Solid, ...] | None:
    """Return the solids of a body between the pads; None, for all of it, if there is none."""
    middle, half_m = float(tool.rotation[:, 0] @ tool.position), hand.finger_width_m / 2
    return solids_between(body, tool.rotation[:, 0], middle - half_m, middle + half_m) or None


def _stated(state: WorldState, gripper: str, thing: str, stated: str) -> GraspCandidate:
    tool, widest = pose(state, stated), sheet_of(state, gripper).number("maxOpening")
    width_m = width_between(state, gripper, thing, tool)
    if width_m is None:
        width_m = widest - LEAST_CLEARANCE_M
    if width_m > widest - LEAST_CLEARANCE_M:
        short = state.vocabulary.short
        raise too_wide(short(thing), short(gripper), [width_m], widest)
    return GraspCandidate(tool, width_m, min(width_m + OPENING_CLEARANCES_M[0], widest))


@lru_cache(maxsize=16)
def _read_scene(state: WorldState, gripper: str, thing: str, with_movable: bool = True) -> GraspScene:
    """Return what a grasp is derived from; what a body is believed to overlap says nothing about room around it."""
    body = read_body(state, thing)
    if body is None:
        pose(state, thing)
        short = state.vocabulary.short(thing)
        raise GraspError(f"nothing says how to grasp {short}: it has no body", "state a skiros:GraspingPose")
    boxes = occupant_of(body).boxes
    others = tuple(
        each
        for each in read_occupants(state)
        if each.individual != thing
        and (with_movable or not each.movable)
        and not state.is_a(each.individual, FIXTURE)
        and not any(overlaps(box, each.solids) for box in boxes)
    )
    away = away_from_arm(state, gripper, body.pose.position)
    return GraspScene(state, gripper, body, read_hand_shape(state, gripper), away, others)


def _derive(scene: GraspScene, way: str) -> tuple[GraspCandidate, ...]:
    if way == "side":
        return derive_from_side(scene)
    if way == "top":
        return derive_by_top(scene)
    above = derive_from_above(scene)
    return above if way == "above" else above[1:]


def _derive_any(scene: GraspScene) -> tuple[GraspCandidate, ...]:
    """Return the grasps from above, else by the top, else from the side; the reason against the first counts."""
    try:
        return derive_from_above(scene)
    except GraspError:
        for derive in (derive_by_top, derive_from_side):
            with suppress(GraspError):
                if found := derive(scene):
                    return found
        raise
