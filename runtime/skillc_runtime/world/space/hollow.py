"""Spatial relations of bodies that are not boxes: how far they reach, what is under them, and what lies in a bin."""

from __future__ import annotations

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.bodies import RigidBody, has_body, read_body
from skillc_runtime.world.space.bounding_boxes import TOUCH_M, bounding_box, solid_box
from skillc_runtime.world.space.shape.oriented_box import OrientedBox
from skillc_runtime.world.space.shape.shapes import Bin
from skillc_runtime.world.state.terms import CONTAINER, SHAPE
from skillc_runtime.world.state.world_state import WorldState

DOWN = np.array([0.0, 0.0, -1.0])


def gap_below(state: WorldState, upper: str, lower: str) -> float | None:
    """Return the height in m of the lowest point of an object over the top of another, vertically below its middle.

    Of a body with several solids, such as a bin or a shelf, that is the highest of its tops that the object does not
    reach below. None when the other is not below its middle. FrameError when a pose is not known, MissingFact without
    a size.
    """
    x, y, _ = bounding_box(state, upper).middle.position.tolist()
    tops = [top for box in _boxes(state, lower) if (top := box.height_at(x, y)) is not None]
    if not tops:
        return None
    lowest = -reach_along(state, upper, DOWN)
    gaps = [lowest - top for top in tops]
    return min((gap for gap in gaps if gap >= -TOUCH_M), default=max(gaps))


def reach_along(state: WorldState, individual: str, direction: Array) -> float:
    """Return how far an object reaches along `direction`, a unit vector (3,), in m from the origin of the world."""
    body = _shaped(state, individual)
    if body is None:
        return float((bounding_box(state, individual).corners @ direction).max())
    return max(each.reach(direction, body.pose) for each in body.solids)


def why_not_in_bin(state: WorldState, subject: str, bin_: str, shape: Bin) -> str | None:
    """Return why an object does not lie in a bin; None if it is between its walls, its middle below the rim."""
    outer, short = solid_box(state, bin_), state.vocabulary.short
    axes, middle = outer.middle.rotation.T, bounding_box(state, subject).middle.position
    room = outer.middle.apply(np.array([0.0, 0.0, shape.wall_m / 2]))
    half = np.array(shape.inside) / 2
    over = [_overhang(state, subject, axis, room, h) for axis, h in zip(axes[:2], half[:2], strict=True)]
    below = reach_along(state, subject, -axes[2]) + float(axes[2] @ room) - float(half[2])
    if max(*over, below) > TOUCH_M:
        return f"{short(subject)} sticks out by {max(*over, below):.3f} m"
    above_rim_m = float(axes[2] @ (middle - room) - half[2])
    return f"the middle of {short(subject)} is {above_rim_m:.3f} m above the rim" if above_rim_m > 0 else None


def bin_shape(state: WorldState, individual: str) -> Bin | None:
    """Return the shape of a bin; None for everything else."""
    body = _shaped(state, individual)
    return body.shape if body is not None and isinstance(body.shape, Bin) else None


def _overhang(state: WorldState, subject: str, axis: Array, room: Array, half: float) -> float:
    """Return how far an object reaches beyond the ends of a room along a unit vector (3,), in m; room: its middle."""
    beyond = reach_along(state, subject, axis) - float(axis @ room)
    before = reach_along(state, subject, -axis) + float(axis @ room)
    return max(beyond, before) - half


def _boxes(state: WorldState, individual: str) -> list[OrientedBox]:
    body = _shaped(state, individual)
    if body is None:
        return [solid_box(state, individual)]
    return [OrientedBox.of(body.pose @ each.place, np.array(each.half)) for each in body.solids]


def _shaped(state: WorldState, individual: str) -> RigidBody | None:
    """Return a body that is not a box, None for everything else."""
    stated = state.value(individual, SHAPE)
    plain = stated == "box" or (stated is None and not state.is_a(individual, CONTAINER))
    return None if plain or not has_body(state, individual) else read_body(state, individual)
