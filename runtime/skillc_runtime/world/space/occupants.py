"""What takes up room in a world: bodies, and the boxes of what is modelled in another way."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from functools import lru_cache

import msgspec
from msgspec.structs import replace

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bodies import REGIONS, RigidBody, has_body, read_body
from skillc_runtime.world.space.bounding_boxes import solid_box
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.shape.oriented_box import OrientedBox
from skillc_runtime.world.space.shape.solids import Solid
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.terms import ARM_DEVICE, END_EFFECTOR, MANIPULATABLE, PERSON, SENSOR, SIZE
from skillc_runtime.world.state.world_state import WorldState

WITHOUT_ROOM = (*REGIONS, ARM_DEVICE, END_EFFECTOR, SENSOR, PERSON)
"""Classes of what takes up no room, or whose room depends on a posture."""

HERE = Pose.of((0.0, 0.0, 0.0))


class Occupant(msgspec.Struct, frozen=True, eq=False):
    """A thing that takes up room: its convex solids and its centre of mass (3,) in m, in the world.

    movable: whether it lies free. low, high: the corners (3,) in m of the smallest box along the axes of the world.
    """

    individual: str
    solids: tuple[Solid, ...]
    centre: Array
    movable: bool
    low: Array
    high: Array

    @property
    def boxes(self) -> tuple[OrientedBox, ...]:
        """The boxes around the solids."""
        return tuple(OrientedBox.of(each.place, np.array(each.half)) for each in self.solids)


@lru_cache(maxsize=4)
def read_occupants(state: WorldState) -> tuple[Occupant, ...]:
    """Return everything that takes up room, in order of IRI; without what has no known pose or an impossible shape."""
    sized = sorted({each for name in SIZE if (values := state.stored.get(name)) for each, _ in values.items()})
    return tuple(_occupants(state, sized))


def near_pairs(occupants: tuple[Occupant, ...]) -> list[tuple[Occupant, Occupant]]:
    """Return the pairs whose boxes along the axes of the world overlap."""
    ordered = sorted(occupants, key=lambda each: float(each.low[0]))
    return list(_sweep(ordered))


def occupant_of(body: RigidBody) -> Occupant:
    """Return the room that a body takes up."""
    solids = tuple(replace(each, place=body.pose @ each.place) for each in body.solids)
    return _occupant(body.individual, solids, body.pose.apply(body.centre), body.movable)


def _sweep(ordered: list[Occupant]) -> Iterator[tuple[Occupant, Occupant]]:
    """Yield the pairs that meet of occupants in order of their lowest x."""
    lows = np.array([each.low for each in ordered])
    highs = np.array([each.high for each in ordered])
    for index, one in enumerate(ordered):
        meets = (lows[index + 1 :] < one.high).all(axis=1) & (highs[index + 1 :] > one.low).all(axis=1)
        yield from ((one, ordered[index + 1 + other]) for other in np.flatnonzero(meets).tolist())


def _occupants(state: WorldState, sized: list[str]) -> Iterator[Occupant]:
    for individual in sized:
        if any(state.is_a(individual, cls) for cls in WITHOUT_ROOM):
            continue
        with suppress(FrameError, SheetError):
            yield from filter(None, (_read_occupant(state, individual),))


def _read_occupant(state: WorldState, individual: str) -> Occupant | None:
    return _of_body(state, individual) if has_body(state, individual) else _of_box(state, individual)


def _of_body(state: WorldState, individual: str) -> Occupant | None:
    body = read_body(state, individual)
    return None if body is None else occupant_of(body)


def _of_box(state: WorldState, individual: str) -> Occupant:
    box = solid_box(state, individual)
    x, y, z = box.half.tolist()
    solid = Solid("box", (x, y, z), Pose(box.middle.position, box.middle.rotation))
    return _occupant(individual, (solid,), box.middle.position, state.is_a(individual, MANIPULATABLE))


def _occupant(individual: str, solids: tuple[Solid, ...], centre: Array, movable: bool) -> Occupant:
    high = np.array([max(each.reach(axis, HERE) for each in solids) for axis in np.eye(3)])
    low = np.array([-max(each.reach(-axis, HERE) for each in solids) for axis in np.eye(3)])
    return Occupant(individual, solids, centre, movable, low, high)
