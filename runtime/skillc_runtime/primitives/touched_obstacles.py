"""Writes to the world model that something stands where an arm has touched something, though nothing was known there.

How large it is nobody has seen. It is assumed to stand on what is known to be below, or on the floor, to be WIDTH_M
wide and deep, and to end HIGHER_M above the place of the touch. Where it begins is measured: the arm is beside it.
"""

from __future__ import annotations

from contextlib import suppress
from itertools import count
from typing import TYPE_CHECKING, Final

import numpy as np

from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.arm_parts import ArmParts
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bounding_boxes import bounding_box
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import placement_changes, pose
from skillc_runtime.world.space.occupants import read_occupants
from skillc_runtime.world.space.shape.oriented_box import OrientedBox
from skillc_runtime.world.space.shape.solids import Solid
from skillc_runtime.world.state.changes import AddIndividual, RemoveIndividual, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.terms import ARM_DEVICE, HAS_GRIPPER, PERSON, SIZE, TOUCHED_OBSTACLE
from skillc_runtime.world.state.world_state import WorldState

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell

WIDTH_M: Final = 0.04
"""How wide and deep a touched obstacle is assumed to be, in m: little, since a wider one is touched again beside it."""

HIGHER_M: Final = 0.05
"""How far a touched obstacle is assumed to go on above the place of the touch, in m."""

NEAR_M: Final = 0.05
"""A touch so near to another arm is a touch of that arm, in m."""

HERE: Final = Pose.of((0.0, 0.0, 0.0))

STEEP: Final = 0.7
"""The height of a direction, 1 for straight up or down, from which on a touch is one from above or below."""


def note_obstacle(cell: Cell, arm: str, into: Array, origin: str) -> None:
    """Write what an arm touches in the direction `into`, a unit vector (3,) in the world.

    Nothing is written where people work, near another arm, if it is not known where the parts of the arm are, or if the
    library was compiled before there were touched obstacles.
    """
    state = cell.world.snapshot()
    if state.instances(PERSON) or TOUCHED_OBSTACLE not in state.vocabulary.classes:
        return
    with suppress(FrameError, SheetError, KeyError, ValueError):
        into = _straighten(into)
        parts, base = _read_parts(cell, state, arm), pose(state, arm)
        hand = parts.list_hand(cell.arm(arm).measured.q, base)
        touched = _find_foremost([each.solid_at(HERE) for each in hand], into)
        if not _is_near_other_arm(cell, state, arm, touched):
            _write(cell, _assume_box(state, touched, into), origin)


def find_explained(state: WorldState, thing: str) -> list[RemoveIndividual]:
    """Return that no touched obstacle is where a thing was found to be now, since it was that which was touched."""
    with suppress(FrameError):
        corners = bounding_box(state, thing).corners
        low, high = corners.min(axis=0) - NEAR_M, corners.max(axis=0) + NEAR_M
        boxes = ((each, bounding_box(state, each).corners) for each in sorted(state.instances(TOUCHED_OBSTACLE)))
        return [RemoveIndividual(each) for each, box in boxes if (box < high).any(0).all() and (box > low).any(0).all()]
    return []


def _straighten(into: Array) -> Array:
    """Return a direction (3,) as a horizontal one, or straight up or down if it is steep."""
    if abs(into[2]) > STEEP:
        return np.array([0.0, 0.0, np.sign(into[2])])
    level = np.array([into[0], into[1], 0.0])
    straight: Array = level / np.linalg.norm(level)
    return straight


def _read_parts(cell: Cell, state: WorldState, arm: str) -> ArmParts:
    """Return the parts of an arm, with its fingers as far open as they are."""
    openings = {each: cell.gripper(each).opening_m for each in state.objects(arm, HAS_GRIPPER)}
    return ArmParts(read_arm_assembly(state, arm, openings))


def _find_foremost(solids: list[Solid], into: Array) -> Array:
    """Return the point (3,) in m in the world of parts that is farthest in a direction (3,); ValueError if none."""
    far_m, number = max((each.reach(into, HERE), number) for number, each in enumerate(solids))
    middle = solids[number].place.position
    point: Array = middle + (far_m - float(middle @ into)) * into
    return point


def _is_near_other_arm(cell: Cell, state: WorldState, arm: str, point: Array) -> bool:
    """Whether a point (3,) in m in the world is near a part of another arm of the cell."""
    for other in sorted(state.instances(ARM_DEVICE) - {arm}):
        with suppress(FrameError, SheetError, KeyError, ValueError):
            parts = _read_parts(cell, state, other).list_obstacles(cell.arm(other).measured.q, pose(state, other))
            solids = (each.solid_at(HERE) for each in parts)
            boxes = (OrientedBox.of(each.place, np.array(each.half)) for each in solids)
            if any(box.distance(point[None, :]) < NEAR_M for box in boxes):
                return True
    return False


def _assume_box(state: WorldState, touched: Array, into: Array) -> OrientedBox:
    """Return the upright box that is assumed to begin at a touched point (3,) in m, in a direction (3,)."""
    x, y, z = (touched + WIDTH_M / 2 * np.array([into[0], into[1], 0.0])).tolist()
    if into[2] > 0.0:  # it hangs there
        low, high = z, z + WIDTH_M
    else:
        low = _find_support(state, x, y, z)
        high = z if into[2] < 0.0 else z + HIGHER_M
    ahead = np.array([into[0], into[1], 0.0]) if into[2] == 0.0 else np.array([1.0, 0.0, 0.0])
    up = np.array([0.0, 0.0, 1.0])
    turned = np.column_stack([ahead, np.cross(up, ahead), up])
    middle = Pose(np.array([x, y, (low + high) / 2]), turned)
    return OrientedBox.of(middle, np.array([WIDTH_M, WIDTH_M, high - low]) / 2)


def _find_support(state: WorldState, x: float, y: float, z: float) -> float:
    """Return the height in m of what is known to be below a point (x, y, z) in m in the world; 0 for the floor."""
    tops = (box.height_at(x, y) for each in read_occupants(state) for box in each.boxes)
    return max((top for top in tops if top is not None and top < z), default=0.0)


def _write(cell: Cell, box: OrientedBox, origin: str) -> None:
    """Write that something is where a box is; its size is assumed."""
    world = cell.world
    state = world.snapshot()
    individual = _name_new(state)
    world.commit(
        [AddIndividual(individual, (TOUCHED_OBSTACLE,)), *placement_changes(individual, box.middle)], origin, "sensed"
    )
    sizes = zip(SIZE, (2 * box.half).tolist(), strict=True)
    world.commit([SetProperty(individual, name, float(value)) for name, value in sizes], origin, "assumed")


def _name_new(state: WorldState) -> str:
    """Return the IRI of an individual that does not exist yet, beside the arms of the world."""
    arm = min(state.instances(ARM_DEVICE))
    beside = arm[: max(arm.rfind("#"), arm.rfind("/")) + 1]
    names = (f"{beside}Touched-{number}" for number in count(1))
    return next(each for each in names if each not in state.individuals)
