"""The horizontal rectangles of a carrier on which things can be put down: its top, its floor, its boards."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from msgspec.structs import replace

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bodies import read_shape
from skillc_runtime.world.space.bounding_boxes import bounding_box
from skillc_runtime.world.space.floors import shelf_board
from skillc_runtime.world.space.shape.shapes import Bin, Shelf
from skillc_runtime.world.state.terms import CONTAIN, FURNITURE, SIZE
from skillc_runtime.world.state.world_state import WorldState

GREATEST_TILT_DEG = 20.0
"""Nothing stands on or in what is tilted further."""

QUARTERS = tuple(np.array([[c, s, 0.0], [s, -c, 0.0], [0.0, 0.0, -1.0]]) for c, s in ((1, 0), (0, 1), (0, -1), (-1, 0)))
"""The rotations (3, 3) of a hand that points down, in the frame of a support: first as its x points."""


class Support(msgspec.Struct, frozen=True, eq=False):
    """A horizontal rectangle that carries things: its middle in the world, half its sides (2,) in m.

    rim_m: how high its walls stand above it; 0 without walls. board: of a shelf, 0 for its top and for all else.
    x of its frame is the side that points off an arm.
    """

    individual: str
    middle: Pose
    half: Array
    rim_m: float
    board: int = 0


def name_support(state: WorldState, support: Support) -> str:
    """Return the name of what carries, with the number of its board."""
    name = state.vocabulary.short(support.individual)
    return f"board {support.board} of {name}" if support.board else name


def find_supports(state: WorldState, to: str) -> list[Support]:
    """Return what carries things in a place: its own supports, or those of the furniture in a place without a size."""
    if state.value(to, SIZE[0]) is not None:
        return [_support(state, to), *_boards(state, to)]
    carriers = (each for each in state.objects(to, CONTAIN) if state.is_a(each, FURNITURE))
    return [_support(state, each) for each in sorted(carriers)]


def _support(state: WorldState, individual: str) -> Support:
    shape = read_shape(state, individual)
    box = bounding_box(state, individual)
    if isinstance(shape, Bin):
        x, y, z = shape.inside
        floor = box.middle @ Pose.of((0.0, 0.0, shape.wall_m - float(box.half[2])))
        return Support(individual, floor, np.array([x, y]) / 2, z)
    return Support(individual, box.middle @ Pose.of((0.0, 0.0, float(box.half[2]))), box.half[:2], 0.0)


def _boards(state: WorldState, individual: str) -> Iterator[Support]:
    """Yield the boards of a shelf below its top, the highest first; nothing for all else."""
    shape = read_shape(state, individual)
    if isinstance(shape, Shelf):
        middle = bounding_box(state, individual).middle
        for number in range(shape.boards - 1, 0, -1):
            board = shelf_board(shape, number)
            place = middle @ Pose(board.middle + np.array([0.0, 0.0, board.half[2]]), np.eye(3))
            yield Support(individual, place, board.half[:2], 0.0, number)


def clearance_m(state: WorldState, to: str) -> float:
    """Return how high the walls of a carrier stand above what it carries, in m."""
    return max((each.rim_m for each in find_supports(state, to)), default=0.0)


def tilt_problem(state: WorldState, support: Support) -> str | None:
    """Return that a support is tilted too far for anything to stand on it; None if it is not."""
    tilt = tilt_deg(support)
    if tilt <= GREATEST_TILT_DEG:
        return None
    where = name_support(state, support)
    return f"{where} is tilted by {tilt:.0f} deg, and things stand where it is {GREATEST_TILT_DEG:.0f} deg at most"


def tilt_deg(support: Support) -> float:
    """Return by how much a support is tilted, in degrees."""
    return float(np.degrees(np.arccos(np.clip(support.middle.rotation[2, 2], -1.0, 1.0))))


def face_away(support: Support, base: Array) -> Support:
    """Return a support in that frame of its sides whose x points off an arm, whose base (3,) is in m."""
    away = support.middle.position - base
    quarters = (support.middle @ Pose(np.zeros(3), turn * np.array([1.0, -1.0, -1.0])) for turn in QUARTERS)
    middle = max(quarters, key=lambda each: round(float(each.rotation[:, 0] @ away), 6))
    swapped = abs(float(middle.rotation[:, 0] @ support.middle.rotation[:, 0])) < 0.5
    return replace(support, middle=middle, half=support.half[::-1] if swapped else support.half)
