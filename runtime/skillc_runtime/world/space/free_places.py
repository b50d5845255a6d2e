"""A free place for a held thing on or in a carrier, beside what is known to be there."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bodies import read_shape
from skillc_runtime.world.space.frame_tree import frame_tree_of
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.grasp_geometry import APPROACH_M
from skillc_runtime.world.space.hand_shape import RELEASE_CLEARANCES_M, HandShape, read_hand_shape
from skillc_runtime.world.space.no_place import NEAR_BASE_M, REACH_SHARE, Neighbour, PlaceError, WantedRoom
from skillc_runtime.world.space.occupants import Occupant, read_occupants
from skillc_runtime.world.space.oriented_box import CORNERS
from skillc_runtime.world.space.overhead import HAND_ABOVE_M, roof_problem
from skillc_runtime.world.space.shapes import solids_of
from skillc_runtime.world.space.solids import Solid
from skillc_runtime.world.space.supports import QUARTERS, Support, face_away, find_supports, name_support, tilt_problem
from skillc_runtime.world.state.data_sheet import sheet_of
from skillc_runtime.world.state.terms import HELD_SIDEWAYS
from skillc_runtime.world.state.world_state import WorldState

GAP_M = 0.01
"""How far from what is beside it a thing is put down."""

FINGER_M = 0.03
"""How much room a finger gets beside a thing when it lets go."""

FINGER_SLACK_M = 0.003
"""How much wider a finger may be on each side than its data sheet says, where there is less room."""

PALM_SLACK_M = 0.003
"""How much higher a palm may be than its data sheet says."""

HAND_M = 0.035
"""Half the width of a hand across the direction in which it closes."""

PITCH_M = 0.01
"""How far from each other the places are that are tried."""

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


def free_hand_pose(state: WorldState, arm: str, gripper: str, thing: str, to: str) -> Pose:
    """Return the pose of the hand, in the world, in which a held thing stands free on or in a carrier.

    PlaceError if nothing there carries it, it does not fit, everything is taken, or it is out of reach. FrameError,
    MissingFact or SheetError if facts are missing.
    """
    short, loads = state.vocabulary.short, [_read_load(state, gripper, thing, room) for room in (_ample, _narrow)]
    supports = [face_away(each, pose(state, arm).position) for each in find_supports(state, to)]
    tilted = next(filter(None, (tilt_problem(state, each) for each in supports)), None)
    if tilted is not None:
        raise PlaceError(f"{short(thing)} cannot be put down: {tilted}")
    if not supports:
        raise PlaceError(
            f"{short(to)} has no size, and contains nothing that could carry {short(thing)}: "
            "state skiros:SizeX, SizeY and SizeZ, or a skiros:PlacingPose",
            "size",
        )
    others = [each for each in read_occupants(state) if each.individual != thing]
    failures = []
    for support in supports:
        neighbours = [
            solid for each in others if each.individual != support.individual for solid in _in_frame(each, support)
        ]
        found = _best_of(state, arm, support, loads, neighbours)
        if isinstance(found, Pose):
            return found
        failures.append(found)
    why = "; ".join(dict.fromkeys(map(str, failures)))
    raise PlaceError(f"{short(thing)} cannot be put down: {why}", failures[-1].lack)


def pose_in_hand(state: WorldState, gripper: str, thing: str) -> Pose:
    """Return the pose of a held thing in the frame of the hand; PlaceError if the hand does not hold it."""
    space = frame_tree_of(state)
    if space.carrier(thing) != gripper:
        short = state.vocabulary.short
        raise PlaceError(f"{short(gripper)} does not hold {short(thing)}")
    return space.own_pose(thing)


def _best_of(
    state: WorldState, arm: str, support: Support, loads: Iterable[Load], neighbours: list[Neighbour]
) -> Pose | PlaceError:
    """Return the best hand pose on a support: with less room around the hand only if it is too small for more."""
    found: Pose | PlaceError | None = None
    for load in loads:
        found = _roof_problem(state, support, load) or _best(state, arm, support, load, neighbours)
        if isinstance(found, Pose) or found.lack != "room":
            break
    assert found is not None, "there is a load"
    return found


def _roof_problem(state: WorldState, support: Support, load: Load) -> PlaceError | None:
    """Return that a hand from above does not fit between a support and what is above it; None if it does."""
    height_m = -float(_extent(load.corners, load.turns[0])[0][2])
    found = roof_problem(state, support.middle.position + np.array([0.0, 0.0, 0.001]), height_m + HAND_ABOVE_M)
    return None if found is None else PlaceError(f"on {name_support(state, support)}, {found}", "headroom")


def _ample(_hand: HandShape) -> tuple[float, float]:
    """Return the room in m that fingers get: on each side, across the direction in which they close and along it."""
    return HAND_M, FINGER_M


def _narrow(hand: HandShape) -> tuple[float, float]:
    """Return the least room in m that fingers need, as above."""
    return hand.finger_width_m / 2 + FINGER_SLACK_M, hand.finger_thickness_m + RELEASE_CLEARANCES_M[-1] / 2


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


def _in_frame(other: Occupant, support: Support) -> Iterator[Neighbour]:
    """Yield the solids of what takes up room, in the frame of a support."""
    for box in other.boxes:
        local = (box.corners - support.middle.position) @ support.middle.rotation
        low, high = local.min(axis=0), local.max(axis=0)
        over = bool((abs((low + high)[:2] / 2.0) < support.half).all())
        yield Neighbour(other.individual, low, high, other.movable and over)


def _best(state: WorldState, arm: str, support: Support, load: Load, neighbours: list[Neighbour]) -> Pose | PlaceError:
    """Return the free hand pose nearest to the middle of a support, or why there is none."""
    sheet, base = sheet_of(state, arm), pose(state, arm)
    reach_m, shoulder = sheet.number("reach"), base.apply(np.array([0.0, 0.0, sheet.number("shoulderHeight")]))
    blockers: list[Neighbour] = []
    distances_m: list[float] = []
    for hand in _hands(support, load):
        blocker = _find_blocker(hand, load, neighbours)
        if blocker is not None:
            blockers.append(blocker)
            continue
        found = support.middle @ hand
        away = found.position - base.position
        distances_m.append(float(np.linalg.norm(found.position - shoulder)))
        if distances_m[-1] < REACH_SHARE * reach_m and np.hypot(*away[:2]) > NEAR_BASE_M:
            return found
    room = WantedRoom(state, support, np.ptp(load.corners, axis=0)[:2], _needed(support, load))
    if distances_m:
        return room.describe_distance(arm, reach_m, distances_m)
    return room.describe_blocked(blockers) if blockers else room.describe_misfit()


def _needed(support: Support, load: Load) -> Array:
    """Return the sides (2,) in m of the least support in whose middle the load stands, turned as it fits best."""
    rooms = [_room(support, load, rotation)[1:] for rotation in load.turns]
    sides = [2.0 * np.maximum(-low, high) for low, high in rooms]
    return min(sides, key=lambda each: float(np.maximum(each - 2.0 * support.half, 0.0).sum()))


def _hands(support: Support, load: Load) -> Iterator[Pose]:
    """Yield the hand poses in the frame of a support whose load stands within its edges.

    Between walls first in rows, so that many things fit; then, and without walls at once, from the middle outwards.
    """
    if support.rim_m > 0.0:
        yield from (hand for hand in _rows(support, load) if _is_within_walls(support, load.palm, hand))
    turns = [(rotation, *_room(support, load, rotation)) for rotation in load.turns]
    for x, y in _grid(support.half):
        for rotation, height_m, low, high in turns:
            if (np.array([x, y]) + low >= -support.half).all() and (np.array([x, y]) + high <= support.half).all():
                yield Pose(np.array([x, y, height_m]), rotation)


def _rows(support: Support, load: Load) -> Iterator[Pose]:
    """Yield the hand poses in which things of the size of the load fill a support evenly, with room for the fingers."""
    filled = []
    for rotation in load.turns:
        height_m, low, high = _room(support, load, rotation)
        least, most = _extent(load.fingers, rotation)
        low, high = np.minimum(low - GAP_M / 2, least[:2]), np.maximum(high + GAP_M / 2, most[:2])
        counts = np.floor(2.0 * support.half / (high - low)).astype(int)
        pitch = 2.0 * support.half / np.maximum(counts, 1)
        middle = -support.half - (low + high) / 2.0
        filled.append(
            [
                Pose(np.array([*(middle + pitch * (np.array(cell) + 0.5)), height_m]), rotation)
                for cell in np.ndindex(*counts)
            ]
        )
    yield from (hand for hands in sorted(filled, key=len, reverse=True) for hand in hands)


def _room(support: Support, load: Load, rotation: Array) -> tuple[float, Array, Array]:
    """Return the height in m of the hand, and the lowest and highest corner (2,) in m of the room that it needs.

    Fingers and palm need room between walls that are higher than their lower ends.
    """
    low, high = _extent(load.corners, rotation)
    height_m = -float(low[2])
    for part in (load.fingers, load.palm):
        least, most = _extent(part, rotation)
        if height_m + least[2] < support.rim_m:
            low, high = np.minimum(low, least), np.maximum(high, most)
    return height_m, low[:2], high[:2]


def _is_within_walls(support: Support, palm: Array, hand: Pose) -> bool:
    """Whether the palm (8, 3) of a hand is above the walls of a support, or between them."""
    least, most = _extent(palm, hand.rotation)
    if hand.position[2] + least[2] >= support.rim_m:
        return True
    middle = hand.position[:2]
    return bool((middle + least[:2] >= -support.half).all() and (middle + most[:2] <= support.half).all())


def _grid(half: Array) -> list[tuple[float, float]]:
    """Return points in m on a grid over a rectangle with half sides (2,) in m, in order of distance from its middle."""
    xs, ys = (np.arange(-int(each / PITCH_M), int(each / PITCH_M) + 1) * PITCH_M for each in half.tolist())
    points = [(float(x), float(y)) for x in xs for y in ys]
    return sorted(points, key=lambda each: (round(each[0] ** 2 + each[1] ** 2, 9), each))


def _extent(corners: Array, rotation: Array) -> tuple[Array, Array]:
    turned = corners @ rotation.T
    return turned.min(axis=0), turned.max(axis=0)


def _find_blocker(hand: Pose, load: Load, neighbours: list[Neighbour]) -> Neighbour | None:
    """Return what is where the load and the fingers will be, or above them but for the hand; None if nothing is."""
    for corners, gap_m in ((load.corners, GAP_M), (load.fingers, 0.0)):
        low, high = _extent(corners, hand.rotation)
        low, high = low + hand.position, high + hand.position
        for other in neighbours:
            beside = (other.low[:2] >= high[:2] + gap_m).any() or (other.high[:2] <= low[:2] - gap_m).any()
            above = other.low[2] > hand.position[2] + HAND_ABOVE_M
            if not beside and not above and other.high[2] > low[2] + 0.001:
                return other
    return None
