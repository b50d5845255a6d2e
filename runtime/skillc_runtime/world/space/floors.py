"""The inner boxes on which things stand that are on a bin or on a board of a shelf: its floor, and its boards."""

from __future__ import annotations

from skillc_runtime.motion.arrays import np
from skillc_runtime.world.space.shape.extents import LocalBox
from skillc_runtime.world.space.shape.shapes import Bin, ShapeError, Shelf, solids_of


def bin_floor(shape: Bin) -> LocalBox:
    """Return the floor between the walls, in the frame in the middle of the bin."""
    floor, (x, y, _) = solids_of(shape)[0], shape.inside
    return LocalBox(np.array([x / 2, y / 2, floor.half[2]]), floor.place.position)


def shelf_board(shape: Shelf, number: int) -> LocalBox:
    """Return a board, of which 1 is the lowest, in the frame in the middle of the shelf; ShapeError without it."""
    if not 1 <= number <= shape.boards:
        raise ShapeError(f"has no board {number}: it has {shape.boards or 'none'}")
    board = solids_of(shape)[number - 1]
    return LocalBox(np.array(board.half), board.place.position)
