"""Outlines of things for drawings: points whose convex hull is a thing, and the hull of points in a plane."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.shape.extents import LocalBox
from skillc_runtime.world.space.shape.oriented_box import CORNERS
from skillc_runtime.world.state.terms import SHAPE, SIZE
from skillc_runtime.world.state.world_state import WorldState

RINGS = {
    "cylinder": (-1.0, 1.0),
    "capsule": (-1.0, 1.0),
    "sphere": (-1.0, -0.9, -0.7, -0.4, 0.0, 0.4, 0.7, 0.9, 1.0),
}
"""The heights of the circles that outline a round shape, as multiples of half its height."""

CIRCLE = np.array([(np.cos(turn), np.sin(turn)) for turn in np.linspace(0.0, 2 * np.pi, 24, endpoint=False)])


def outline_points(state: WorldState, thing: str, at: Pose) -> Array:
    """Return points (n, 3) in m of the world whose hull is a thing at a pose; the pose alone if it has no size."""
    sizes = [state.value(thing, name) for name in SIZE]
    half = np.array([each / 2 if isinstance(each, int | float) else 0.0 for each in sizes])
    points = _unit_points(str(state.value(thing, SHAPE))) * half
    box = LocalBox.of(half, state.classes.get(thing))
    return np.asarray((points + box.middle) @ at.rotation.T + at.position)


def convex_hull(points: Array) -> Array:
    """Return the corners (k, 2) of the convex hull of points (n, 2), counter-clockwise. Andrew's monotone chain."""
    ordered = sorted({(round(x, 9), round(y, 9)) for x, y in points.tolist()})
    if len(ordered) < 3:
        return np.array(ordered)
    return np.array([*_half_hull(ordered)[:-1], *_half_hull(ordered[::-1])[:-1]])


def _unit_points(shape: str) -> Array:
    """Return the points (n, 3) of a shape of half size 1 in all directions."""
    if shape not in RINGS:
        return CORNERS
    wide = np.sqrt(1.0 - np.array(RINGS[shape]) ** 2) if shape == "sphere" else np.ones(len(RINGS[shape]))
    rings = zip(RINGS[shape], wide.tolist(), strict=True)
    return np.vstack([np.column_stack([width * CIRCLE, np.full(len(CIRCLE), height)]) for height, width in rings])


def _half_hull(ordered: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    hull: list[tuple[float, float]] = []
    for x, y in ordered:
        while len(hull) > 1:
            (a, b), (c, d) = hull[-2:]
            if (c - a) * (y - b) - (d - b) * (x - a) > 0:
                break
            hull.pop()
        hull.append((x, y))
    return hull
