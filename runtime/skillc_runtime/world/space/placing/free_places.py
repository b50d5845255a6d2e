"""Free places for a held thing on or in a carrier, beside what is known to be there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain
from math import dist, hypot

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.occupants import Occupant, read_occupants
from skillc_runtime.world.space.overhead import HAND_ABOVE_M, roof_problem
from skillc_runtime.world.space.placing.held_load import Load, read_loads
from skillc_runtime.world.space.placing.no_place import (
    NEAR_BASE_M,
    REACH_SHARE,
    Lack,
    Neighbour,
    PlaceError,
    WantedRoom,
)
from skillc_runtime.world.space.placing.place_sampling import PITCH_M, choose_pitch_m, interleave, spread_out
from skillc_runtime.world.space.reach import hand_length_m
from skillc_runtime.world.space.supports import Support, face_away, find_supports, name_support, tilt_problem
from skillc_runtime.world.state.data_sheet import sheet_of
from skillc_runtime.world.state.world_state import WorldState

OF_ROOM: tuple[Lack, ...] = ("room", "free room", "clearance", "reach")
"""Of what there may be enough if the hand takes less room."""

GAP_M = 0.01
"""How far from what is beside it a thing is put down."""


@dataclass(frozen=True, slots=True, eq=False)
class FreePlace:
    """Where the hand is in the world that puts a held thing down on a support."""

    support: Support
    hand: Pose


def free_hand_pose(state: WorldState, arm: str, gripper: str, thing: str, to: str) -> Pose:
    """Return the pose of the hand, in the world, in which a held thing stands free on or in a carrier.

    Errors as of `list_free_places`.
    """
    return next(list_free_places(state, arm, gripper, thing, to)).hand


def list_free_places(state: WorldState, arm: str, gripper: str, thing: str, to: str) -> Iterator[FreePlace]:
    """Return places in which a held thing stands free on or in a carrier: first where it is put if nothing else counts.

    That is as near to the middle as it can be, between walls in rows. The others are nearby first and sparser farther
    away, also with the hand turned; always the same. What stands at one is within the edges of the support.

    PlaceError if nothing there carries it, it does not fit, everything is taken, or it is out of reach. FrameError,
    MissingFact or SheetError if facts are missing.
    """
    short, loads = state.vocabulary.short, read_loads(state, gripper, thing)
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
    found, failures = list[Iterator[FreePlace]](), list[PlaceError]()
    for support in supports:
        neighbours = [
            solid for each in others if each.individual != support.individual for solid in _in_frame(each, support)
        ]
        there = _list_with_room(state, arm, support, loads, neighbours)
        if isinstance(there, PlaceError):
            failures.append(there)
        else:
            found.append(there)
    if found:
        return interleave(found)
    why = "; ".join(dict.fromkeys(map(str, failures)))
    raise PlaceError(f"{short(thing)} cannot be put down: {why}", failures[-1].lack)


def _list_with_room(
    state: WorldState, arm: str, support: Support, loads: Iterable[Load], neighbours: list[Neighbour]
) -> Iterator[FreePlace] | PlaceError:
    """Return the free places on a support, those with most room around the hand first, or why there is none."""
    found: Iterator[Pose] | PlaceError | None = None
    left = iter(loads)
    for load in left:
        found = _list_free(state, arm, support, load, neighbours)
        if not isinstance(found, PlaceError) or found.lack not in OF_ROOM:
            break
    assert found is not None, "there is a load"
    if isinstance(found, PlaceError):
        return found
    narrower = (_list_free(state, arm, support, load, neighbours) for load in left)
    others = chain.from_iterable(each for each in narrower if not isinstance(each, PlaceError))
    return (FreePlace(support, each) for each in spread_out(chain(found, others), support.half))


def _roof_problem(state: WorldState, support: Support, load: Load) -> PlaceError | None:
    """Return that a hand from above does not fit between a support and what is above it; None if it does."""
    height_m = -float(_extent(load.corners, load.turns[0])[0][2])
    found = roof_problem(state, support.middle.position + np.array([0.0, 0.0, 0.001]), height_m + HAND_ABOVE_M)
    return None if found is None else PlaceError(f"on {name_support(state, support)}, {found}", "headroom")


def _in_frame(other: Occupant, support: Support) -> Iterator[Neighbour]:
    """Yield the solids of what takes up room, in the frame of a support."""
    for box in other.boxes:
        local = (box.corners - support.middle.position) @ support.middle.rotation
        low, high = local.min(axis=0), local.max(axis=0)
        over = bool((abs((low + high)[:2] / 2.0) < support.half).all())
        yield Neighbour(other.individual, low, high, other.movable and over)


def _list_free(
    state: WorldState, arm: str, support: Support, load: Load, neighbours: list[Neighbour]
) -> Iterator[Pose] | PlaceError:
    """Return where the hand is in the world at free places, nearest to the middle first, or why there is none."""
    roof = _roof_problem(state, support, load)
    if roof is not None:
        return roof
    sheet, base = sheet_of(state, arm), pose(state, arm)
    reach_m = sheet.number("reach")
    shoulder = base.apply(np.array([0.0, 0.0, sheet.number("shoulderHeight")])).tolist()
    flange = np.array([0.0, 0.0, -hand_length_m(state, arm)])

    def distance_m(hand: Pose) -> float:
        return min(dist(hand.position.tolist(), shoulder), dist(hand.apply(flange).tolist(), shoulder))

    def is_in_reach(hand: Pose, share: float = REACH_SHARE) -> bool:
        far_m = distance_m(hand) if share == 1.0 else dist(hand.position.tolist(), shoulder)
        return far_m < share * reach_m and hypot(*(hand.position - base.position)[:2].tolist()) > NEAR_BASE_M

    def list_from(first: Pose, share: float) -> Iterator[Pose]:
        coarse = _hands(support, load, choose_pitch_m(support.half))
        free = (support.middle @ each for each in coarse if crowd.find_blocker(each) is None)
        return chain((first,), (each for each in free if is_in_reach(each, share)))

    crowd = _Crowd(load, neighbours)
    blockers: list[Neighbour] = []
    distances_m: list[float] = []
    farther: Pose | None = None
    for hand in _hands(support, load, PITCH_M):
        blocker = crowd.find_blocker(hand)
        if blocker is not None:
            blockers.append(blocker)
            continue
        first = support.middle @ hand
        if is_in_reach(first):
            return list_from(first, REACH_SHARE)
        if farther is None and is_in_reach(first, 1.0):
            farther = first
        distances_m.append(distance_m(first))
    if farther is not None:
        return list_from(farther, 1.0)
    room = WantedRoom(state, support, np.ptp(load.corners, axis=0)[:2], _needed(support, load))
    if distances_m:
        return room.describe_distance(arm, reach_m, distances_m)
    return room.describe_blocked(blockers) if blockers else room.describe_misfit()


def _needed(support: Support, load: Load) -> Array:
    """Return the sides (2,) in m of the least support in whose middle the load stands, turned as it fits best."""
    rooms = [_room(support, load, rotation)[1:] for rotation in load.turns]
    sides = [2.0 * np.maximum(-low, high) for low, high in rooms]
    return min(sides, key=lambda each: float(np.maximum(each - 2.0 * support.half, 0.0).sum()))


def _hands(support: Support, load: Load, pitch_m: float) -> Iterator[Pose]:
    """Yield the hand poses in the frame of a support whose load stands within its edges, so far from each other.

    Between walls first in rows, so that many things fit; then, and without walls at once, from the middle outwards.
    """
    if support.rim_m > 0.0:
        yield from (hand for hand in _rows(support, load) if _is_within_walls(support, load.palm, hand))
    rooms = [(rotation, *_room(support, load, rotation)) for rotation in load.turns]
    turns = [(rotation, height_m, *low.tolist(), *high.tolist()) for rotation, height_m, low, high in rooms]
    half_x, half_y = support.half.tolist()
    for x, y in _grid(support.half, pitch_m):
        for rotation, height_m, low_x, low_y, high_x, high_y in turns:
            if x + low_x >= -half_x and x + high_x <= half_x and y + low_y >= -half_y and y + high_y <= half_y:
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


def _grid(half: Array, pitch_m: float) -> list[tuple[float, float]]:
    """Return points in m on a grid over a rectangle with half sides (2,) in m, in order of distance from its middle."""
    xs, ys = (np.arange(-int(each / pitch_m), int(each / pitch_m) + 1) * pitch_m for each in half.tolist())
    points = [(float(x), float(y)) for x in xs for y in ys]
    return sorted(points, key=lambda each: (round(each[0] ** 2 + each[1] ** 2, 9), each))


def _extent(corners: Array, rotation: Array) -> tuple[Array, Array]:
    turned = corners @ rotation.T
    return turned.min(axis=0), turned.max(axis=0)


class _Crowd:
    """What is beside the places for a load, in the frame of a support."""

    def __init__(self, load: Load, neighbours: list[Neighbour]) -> None:
        self._load, self._neighbours = load, neighbours
        self._low = np.array([each.low for each in neighbours]).reshape(-1, 3)
        self._high = np.array([each.high for each in neighbours]).reshape(-1, 3)
        self._extents = dict[bytes, list[tuple[Array, Array, float]]]()

    def find_blocker(self, hand: Pose) -> Neighbour | None:
        """Return what is where load and fingers will be, or above them but for the hand; None if nothing is."""
        for low, high, gap_m in self._extents_of(hand.rotation):
            low, high = low + hand.position, high + hand.position
            beside = (self._low[:, :2] >= high[:2] + gap_m) | (self._high[:, :2] <= low[:2] - gap_m)
            above = self._low[:, 2] > hand.position[2] + HAND_ABOVE_M
            found = ~beside.any(axis=1) & ~above & (self._high[:, 2] > low[2] + 0.001)
            if found.any():
                return self._neighbours[int(found.argmax())]
        return None

    def _extents_of(self, rotation: Array) -> list[tuple[Array, Array, float]]:
        key = rotation.tobytes()
        if key not in self._extents:
            parts = ((self._load.corners, GAP_M), (self._load.fingers, 0.0))
            self._extents[key] = [(*_extent(corners, rotation), gap_m) for corners, gap_m in parts]
        return self._extents[key]
