"""A held thing and the hand around it: what has to have room where the thing is put down."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bodies import read_shape
from skillc_runtime.world.space.frame_tree import frame_tree_of
from skillc_runtime.world.space.grasping.grasp_geometry import APPROACH_M
from skillc_runtime.world.space.grasping.hand_shape import RELEASE_CLEARANCES_M, HandShape, read_hand_shape
from skillc_runtime.world.space.placing.no_place import PlaceError
from skillc_runtime.world.space.shape.oriented_box import CORNERS
from skillc_runtime.world.space.shape.shapes import solids_of
from skillc_runtime.world.space.shape.solids import Solid
from skillc_runtime.world.space.supports import QUARTERS
from skillc_runtime.world.state.terms import HELD_SIDEWAYS
from skillc_runtime.world.state.world_state import WorldState

FINGER_M = 0.03
"""How much room a finger gets beside a thing when it lets go."""

FINGER_SLACKS_M = (0.003, 0.001)
"""How much wider a finger may be on each side than its data sheet says, where there is less room, and the least."""

HAND_M = 0.035
"""Half the width of a hand across the direction in which it closes."""

PALM_SLACK_M = 0.003
"""How much higher a palm may be than its data sheet says."""

SIDEWAYS = tuple(np.array([[0.0, s, c], [0.0, -c, s], [1.0, 0.0, 0.0]]) for c, s in ((1, 0), (0, 1), (0, -1)))
"""The rotations (3, 3) of a horizontal hand with its x upwards, in the frame of a support: first as its x points."""


@dataclass(frozen=True, slots=True, eq=False)
class Load:
    """A held thing: its corners (n, 3) in m and those of the room (8, 3) in m of fingers and palm, in the hand's frame.

    turns: the rotations (3, 3) of the hand, in the frame of a support, in which it puts the thing down.
    """

    corners: Array
    fingers: Array
    palm: Array
    turns: tuple[Array, ...]


def read_loads(state: WorldState, gripper: str, thing: str) -> list[Load]:
    """Return a held thing with ample room for the fingers that let it go, with less, and with as little as they need.

    PlaceError if the hand does not hold it; MissingFact or SheetError if facts are missing.
    """
    return [_read_load(state, gripper, thing, room) for room in (_ample, _narrow, _tight)]


def pose_in_hand(state: WorldState, gripper: str, thing: str) -> Pose:
    """Return the pose of a held thing in the frame of the hand; PlaceError if the hand does not hold it."""
    space = frame_tree_of(state)
    if space.carrier(thing) != gripper:
        short = state.vocabulary.short
        raise PlaceError(f"{short(gripper)} does not hold {short(thing)}")
    return space.own_pose(thing)


def _ample(_hand: HandShape) -> tuple[float, float]:
    """Return the room in m that fingers get: on each side, across the direction in which they close and along it."""
    return HAND_M, FINGER_M


def _narrow(hand: HandShape) -> tuple[float, float]:
    """Return the room in m that fingers need which open less far, as above."""
    return hand.finger_width_m / 2 + FINGER_SLACKS_M[0], hand.finger_thickness_m + RELEASE_CLEARANCES_M[1] / 2


def _tight(hand: HandShape) -> tuple[float, float]:
    """Return the least room in m that fingers need, as above."""
    return hand.finger_width_m / 2 + FINGER_SLACKS_M[1], hand.finger_thickness_m + RELEASE_CLEARANCES_M[2] / 2


def _read_load(
    state: WorldState, gripper: str, thing: str, room_of: Callable[[HandShape], tuple[float, float]]
) -> Load:
    in_hand = pose_in_hand(state, gripper, thing)
    corners = np.concatenate([_corners(each, in_hand) for each in solids_of(read_shape(state, thing))])
    width_m = float(np.abs(corners[:, 1]).max())
    hand = read_hand_shape(state, gripper)
    across_m, beside_m = room_of(hand)
    if state.value(thing, HELD_SIDEWAYS) is True:
        room = _room_of_horizontal(hand, width_m + beside_m)
        return Load(corners, room, room, SIDEWAYS)
    fingers = CORNERS * np.array([across_m, width_m + beside_m, hand.tip_m])
    behind = np.array([0.0, 0.0, hand.depth_m + PALM_SLACK_M])
    palm = CORNERS * np.array([hand.palm_thickness_m, hand.palm_width_m, 0.0]) / 2 - behind
    return Load(corners, fingers, palm, QUARTERS)


def _corners(solid: Solid, place: Pose) -> Array:
    """Return the corners (8, 3) in m of the box around a solid whose frame is at a pose, along the axes of the hand."""
    axes = np.eye(3)
    low, high = (np.array([sign * solid.reach(sign * axis, place) for axis in axes]) for sign in (-1, 1))
    corners: Array = (low + high) / 2 + CORNERS * (high - low) / 2
    return corners


def _room_of_horizontal(hand: HandShape, half_open_m: float) -> Array:
    """Return the corners (8, 3) in m of the room that a horizontal hand needs, in its frame, until it has withdrawn.

    half_open_m: how far from its middle its open fingers reach.
    """
    behind_m = hand.depth_m + APPROACH_M
    half = np.array([hand.half_height_m, max(half_open_m, hand.palm_width_m / 2), (hand.tip_m + behind_m) / 2])
    corners: Array = CORNERS * half + np.array([0.0, 0.0, (hand.tip_m - behind_m) / 2])
    return corners
