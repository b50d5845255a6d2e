"""Parallel lanes, in alternating directions, along which a rectangular tool covers a rectangle."""

from __future__ import annotations

from math import ceil
from typing import Literal, TypeAlias, assert_never

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose

OVERHANG_M = (0.024, 0.012)
"""How far the tool extends beyond the rectangle at the ends of a lane and beside the outer lanes.

It must exceed the lag of the tool behind its reference, most of which is friction force / stiffness; at the ends
corners are blended as well. With more the tool would tilt over the edge and press unevenly.
"""


Direction: TypeAlias = Literal["longer", "x", "y"]
"""The side of a surface to which lanes are parallel."""


def plan_lanes(
    surface: Array,
    tool: Array,
    overlap: float,
    overhang: tuple[float, float] = OVERHANG_M,
    direction: Direction = "longer",
) -> list[Pose]:
    """Return the two ends of each lane in the surface frame: origin in the centre, z the outward normal.

    The tool's x points along the lane, its z into the surface; it does not rotate between lanes. Raises ValueError if a
    size is not positive.
    surface: (2,) in m, its size.
    tool: (2,) in m, its size, the first one along the lane.
    overlap: 0 to 0.9, the share of the tool's width that neighbouring lanes have in common.
    overhang: m, beyond the ends of a lane, and beside the outer lanes.
    """
    if min(*surface[:2], *tool[:2]) <= 0 or not 0 <= overlap <= 0.9:
        raise ValueError(f"lanes need positive sizes and an overlap of 0 to 0.9: {surface}, {tool}, {overlap}")
    first = lane_axis(surface, direction)
    half_length = max(float(surface[first]) / 2 - (float(tool[0]) / 2 - overhang[0]), 0.0)
    half_width = max(float(surface[1 - first]) / 2 - (float(tool[1]) / 2 - overhang[1]), 0.0)
    pitch = float(tool[1]) * (1 - overlap)
    count = ceil(2 * half_width / pitch - 1e-9) + 1
    along, across = np.eye(3)[first], np.eye(3)[1 - first]
    rotation = np.column_stack([along, np.cross([0.0, 0.0, -1.0], along), [0.0, 0.0, -1.0]])
    ends: list[Pose] = []
    for i, offset in enumerate(np.linspace(-half_width, half_width, count) if count > 1 else [0.0]):
        way = half_length if i % 2 else -half_length
        ends += [Pose(offset * across + end * way * along, rotation) for end in (1, -1)]
    return ends


def lane_axis(surface: Array, direction: Direction) -> int:
    """Return the axis of a surface of size (2,) in m, in its frame, that lanes are parallel to: 0 for x, 1 for y."""
    match direction:
        case "longer":
            return 0 if surface[0] >= surface[1] else 1
        case "x":
            return 0
        case "y":
            return 1
        case _:
            assert_never(direction)
