"""Checks that things that lie free stand on something, with their centre of mass over it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import pi

import numpy as np

from skillc.services.cell_checks.facts import ROUNDED_M, placing_fact, severity_of
from skillc_runtime.motion.pose import Array
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.occupants import Occupant
from skillc_runtime.world.space.shape.oriented_box import OrientedBox
from skillc_runtime.world.space.shape.solids import Solid
from skillc_runtime.world.state.world_state import WorldState

GRID = np.linspace(-1.0, 1.0, 9)
"""Where a footprint is looked at along each of its sides, as a share of half of it."""

ANGLES = np.arange(0.0, 2 * pi, pi / 8)
DIRECTIONS = np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])


def check_support(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield things that hang in the air, or tip over because their centre of mass is beyond what they stand on."""
    for each in occupants:
        if each.movable and placing_fact(state, each.individual) is not None:
            yield from _problem(state, each, [other for other in occupants if _may_support(other, each)])


def _may_support(other: Occupant, thing: Occupant) -> bool:
    beside = (other.low[:2] > thing.high[:2]).any() or (other.high[:2] < thing.low[:2]).any()
    return other is not thing and not beside and float(other.low[2]) <= float(thing.low[2]) + ROUNDED_M


def _problem(state: WorldState, thing: Occupant, others: Sequence[Occupant]) -> Iterator[SceneViolation]:
    short, bottom_m = state.vocabulary.short, float(thing.low[2])
    supports = [(box, short(other.individual)) for other in others for box in other.boxes]
    points, pitch_m = _footprint(thing, [box for box, _ in supports])
    found = [_support(supports, x, y, bottom_m) for x, y in points.tolist()]
    height_m, support = max(found)
    gap_m = bottom_m - height_m
    if gap_m > ROUNDED_M:
        message = f"{short(thing.individual)} hangs {1e3 * gap_m:.0f} mm over {support}, and nothing holds it"
        cure = f"lower it by {1e3 * gap_m:.0f} mm, or give what it stands on its true place and size"
        yield _violation(state, thing, message, cure, gap_m)
        return
    holds = np.array([bottom_m - height <= ROUNDED_M for height, _ in found])
    beyond_m = _distance_beyond(points[holds], thing.centre[:2])
    if beyond_m > pitch_m + ROUNDED_M:
        least_m = beyond_m - pitch_m
        message = f"{short(thing.individual)} tips over: its centre of mass is at least {1e3 * least_m:.0f} mm beyond "
        message += support
        yield _violation(state, thing, message, f"move it until its middle is over {support}", least_m)


def _footprint(thing: Occupant, supports: Sequence[OrientedBox]) -> tuple[Array, float]:
    """Return points (n, 2) in m, in the world, of what a thing stands on, and their greatest distance in m.

    Points of supports are among them, which may be as thin as the rim of a box.
    """
    bottom = float(thing.low[2])
    lowest = [
        (solid, box) for solid, box in zip(thing.solids, thing.boxes, strict=True) if box.lowest <= bottom + ROUNDED_M
    ]
    found = [_standing_points(solid, box) for solid, box in lowest]
    points, pitch_m = [each for each, _ in found], max(pitch for _, pitch in found)
    below_m = 0.0
    for box in supports:
        top = _face_points(box, *np.meshgrid(GRID, GRID))
        over = np.array([_is_over(solid, standing, top) for solid, standing in lowest]).any(axis=0)
        if over.any():
            points.append(top[over])
            below_m = max(below_m, _pitch_m(box))
    return np.concatenate(points), min(pitch_m, below_m or pitch_m)


def _pitch_m(box: OrientedBox) -> float:
    """Return the greatest distance in m of the points of a face of a box."""
    return float(box.half[list(_sides(box))].max()) * float(GRID[1] - GRID[0])


def _is_over(solid: Solid, box: OrientedBox, points: Array) -> Array:
    """Return of which points (n, 2) in m, in the world, the face is above with which a solid stands (n,)."""
    one, other = _sides(box)
    axes = box.middle.rotation[:2, [one, other]]
    local = (points - box.middle.position[:2]) @ np.linalg.pinv(axes).T / box.half[[one, other]]
    if solid.kind == "cylinder" and 2 not in (one, other):
        return np.asarray(np.hypot(*local.T) <= 1.0)
    flat = solid.kind not in ("cylinder", "capsule", "sphere")
    return np.asarray((np.abs(local) <= 1.0).all(axis=1) & flat)


def _sides(box: OrientedBox) -> tuple[int, int]:
    """Return the axes of a box that are the most level."""
    upright = int(np.argmax(np.abs(box.middle.rotation[2])))
    one, other = (axis for axis in range(3) if axis != upright)
    return one, other


def _face_points(box: OrientedBox, u: Array, v: Array) -> Array:
    """Return points (n, 2) in m, in the world, of a box; u, v (n,): shares of half its sides that are most level."""
    first, second = (box.middle.rotation[:2, axis] * box.half[axis] for axis in _sides(box))
    points: Array = np.outer(u.ravel(), first) + np.outer(v.ravel(), second) + box.middle.position[:2]
    return points


def _standing_points(solid: Solid, box: OrientedBox) -> tuple[Array, float]:
    """Return points (n, 2) in m of the lowest face of a solid, in the world, and their greatest distance in m.

    A sphere stands on a point, a cylinder on a disc or a line; a hull is taken as its box.
    """
    one, other = _sides(box)
    upright = 3 - one - other
    u, v = (each.ravel() for each in np.meshgrid(GRID, GRID))
    if solid.kind == "cylinder" and upright == 2:
        inside = np.hypot(u, v) <= 1.0 + 1e-9
        u, v = u[inside], v[inside]
    elif solid.kind in ("cylinder", "capsule", "sphere"):
        along = GRID if solid.kind != "sphere" and upright != 2 else np.zeros(1)
        u, v = (along, np.zeros_like(along)) if one == 2 else (np.zeros_like(along), along)
    return _face_points(box, u, v), _pitch_m(box)


def _support(supports: Sequence[tuple[OrientedBox, str]], x: float, y: float, bottom_m: float) -> tuple[float, str]:
    """Return the height in m of what is below a point, at most the bottom itself, and its name."""
    found = [
        (min(top, bottom_m), name)
        for box, name in supports
        if box.lowest <= bottom_m + ROUNDED_M and (top := box.height_at(x, y)) is not None
    ]
    return max([*found, (min(0.0, bottom_m), "the floor")])


def _distance_beyond(points: Array, centre: Array) -> float:
    """Return how far a centre (2,) is outside the convex hull of points (n, 2), in m; 0 if it is inside."""
    return float(max(0.0, -((points - centre) @ DIRECTIONS.T).max(axis=0).min()))


def _violation(state: WorldState, thing: Occupant, message: str, cure: str, distance_m: float) -> SceneViolation:
    place = placing_fact(state, thing.individual)
    return SceneViolation(thing.individual, place, "no-support", message, cure, severity_of(distance_m))
