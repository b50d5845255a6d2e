"""Leaves bodies that are far from all that they may touch out of the search for contacts, which finds the same ones.

That links collide costs a quarter of a step in free motion, though hardly ever one of them is near anything. So now and
then all clearances are computed. A body with enough of it can touch nothing before joints and bases have moved so far
that it may be used up: the distance of two bodies changes by at most what moves what is between them,

    sum over joints of lever |dq|,

where the lever is the greatest distance of anything that a joint moves from it, in any posture, and 1 for a slide.
"""

from __future__ import annotations

from math import sqrt
from typing import Any, Final

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.backends.mujoco.contact_pairs import find_pairs
from skillc_runtime.backends.mujoco.levers import KNOWN_JOINTS, MOVES_FREELY, SLIDES, find_joints, find_mocap_levers
from skillc_runtime.backends.mujoco.round_shapes import ANGULAR, SHAPE, find_shapes, gap_between_axes
from skillc_runtime.motion.arrays import Matrix, OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import COMPILES, bind, compiled, inlined
from skillc_runtime.motion.numerics.copying import Copies, copy_pieces
from skillc_runtime.motion.numerics.linear import copy_vector
from skillc_runtime.motion.numerics.places import call_entry

FAR_M: Final = 0.012
"""A body with this clearance is left out."""

LOOK_M: Final = 0.2
"""Up to which clearance and way a look is good for."""

ROUNDING_M: Final = 1e-6
"""More than all errors of rounding."""

ANGLE_OF_CHORD: Final = 2.2215
"""An angle between orientations in rad is at most pi / sqrt(2) times the distance of their quaternions."""


class Ways(msgspec.Struct, frozen=True):
    """Where things are, and where they were at the last look.

    joints (n, 5): as of `find_joints`; mocap_levers (n,): m. allowed (1,): m, how far all
    may move; 0 for not at all.
    """

    joints: Matrix
    mocap_levers: Vector
    qpos: Vector
    mocap_pos: Vector
    mocap_quat: Vector
    last_qpos: OutVector
    last_pos: OutVector
    last_quat: OutVector
    allowed: OutVector


class Clearances(msgspec.Struct, frozen=True):
    """What may touch, and what is left out.

    pairs (n, 6): two geoms, their bodies, their contact margin in m, and 1 if the first one is a plane. boxes (ngeom,
    8): centre and half sides in m of the box around a geom, in its frame, the radius of its sphere, and its shape.
    centres (ngeom, 3): of boxes, m, in the world. clear (nbody,): m. fewer, every: what gives the model its contact
    bits without bodies that are left out, and with all. bits (nbody, 6): for kind and partners of a body the address in
    the former, in the latter, and of a zero.
    """

    ways: Ways
    pairs: Matrix
    boxes: Matrix
    xpos: Matrix
    xmat: Matrix
    centres: OutMatrix
    clear: OutVector
    fewer: Copies
    every: Copies
    bits: Matrix


@inlined
def measure_way(ways: Ways) -> float:
    """Return by how much in m the distance of any two things may have changed since the last look."""
    way = 0.0
    for row in range(ways.joints.shape[0]):
        first, kind, lever = int(ways.joints[row, 0]), ways.joints[row, 1], ways.joints[row, 2]
        if kind == MOVES_FREELY:
            way += length_between(ways.qpos, ways.last_qpos, first, 3)
            way += lever * ANGLE_OF_CHORD * length_between(ways.qpos, ways.last_qpos, first + 3, 4)
        else:
            way += lever * abs(ways.qpos[first] - ways.last_qpos[first])
            if kind == SLIDES and not abs(ways.qpos[first] - ways.joints[row, 3]) < ways.joints[row, 4]:
                way += LOOK_M
    for row in range(ways.mocap_levers.size):
        way += length_between(ways.mocap_pos, ways.last_pos, 3 * row, 3)
        way += ways.mocap_levers[row] * ANGLE_OF_CHORD * length_between(ways.mocap_quat, ways.last_quat, 4 * row, 4)
    return way


@inlined
def length_between(one: Vector, other: Vector, first: int, count: int) -> float:
    """Return the length of the difference of `count` elements from `first` on, in their unit."""
    square = 0.0
    for k in range(first, first + count):
        square += (one[k] - other[k]) * (one[k] - other[k])
    return sqrt(square)


@inlined
def place_boxes(near: Clearances) -> None:
    """Compute the centres of all boxes."""
    for geom in range(near.boxes.shape[0]):
        for k in range(3):
            at = near.xpos[geom, k]
            for j in range(3):
                at += near.xmat[geom, 3 * k + j] * near.boxes[geom, j]
            near.centres[geom, k] = at


@inlined
def gap_along(near: Clearances, one: int, other: int, axis: int) -> float:
    """Return how far two boxes are apart along an axis of the first one in m, less than 0 if they overlap there."""
    along = 0.0
    for k in range(3):
        along += near.xmat[one, 3 * k + axis] * (near.centres[other, k] - near.centres[one, k])
    gap = abs(along) - near.boxes[one, 3 + axis]
    for j in range(3):
        share = 0.0
        for k in range(3):
            share += near.xmat[one, 3 * k + axis] * near.xmat[other, 3 * k + j]
        gap -= abs(share) * near.boxes[other, 3 + j]
    return float(gap)


@inlined
def height_over(near: Clearances, plane: int, other: int) -> float:
    """Return how high a box is over a plane in m."""
    height = 0.0
    for k in range(3):
        height += near.xmat[plane, 3 * k + 2] * (near.centres[other, k] - near.xpos[plane, k])
    for j in range(3):
        share = 0.0
        for k in range(3):
            share += near.xmat[plane, 3 * k + 2] * near.xmat[other, 3 * k + j]
        height -= abs(share) * near.boxes[other, 3 + j]
    return height


@inlined
def find_gap(near: Clearances, one: int, other: int) -> float:
    """Return a lower bound of the distance of two geoms in m; LOOK_M if their spheres are so far.

    It is that of their boxes along the axes of these, or, if both are round, along the way between theirs.
    """
    square = 0.0
    for k in range(3):
        square += (near.centres[other, k] - near.centres[one, k]) * (near.centres[other, k] - near.centres[one, k])
    far = near.boxes[one, 6] + near.boxes[other, 6] + LOOK_M
    if square > far * far:
        return LOOK_M
    gap = -1.0
    for axis in range(3):
        gap = max(gap, gap_along(near, one, other, axis), gap_along(near, other, one, axis))
    if near.boxes[one, SHAPE] == ANGULAR or near.boxes[other, SHAPE] == ANGULAR:
        return gap
    return max(gap, gap_between_axes(near.boxes, near.centres, near.xmat, one, other))


@inlined
def look(near: Clearances) -> None:
    """Compute all clearances, at the positions of the last step; leave out what has enough."""
    place_boxes(near)
    for body in range(near.clear.size):
        near.clear[body] = LOOK_M
    for row in range(near.pairs.shape[0]):
        one, other, first, second = (
            int(near.pairs[row, 0]), int(near.pairs[row, 1]), int(near.pairs[row, 2]), int(near.pairs[row, 3]),
        )  # fmt: skip
        gap = height_over(near, one, other) if near.pairs[row, 5] == 1.0 else find_gap(near, one, other)
        gap -= near.pairs[row, 4] + ROUNDING_M
        near.clear[first], near.clear[second] = min(near.clear[first], gap), min(near.clear[second], gap)
    allowed, memmove = LOOK_M, int(near.fewer.memmove)
    for body in range(near.clear.size):
        source = 1
        if near.clear[body] > FAR_M:
            source, allowed = 2, min(allowed, near.clear[body])
        for k in range(0, 6, 3):
            call_entry(memmove, int(near.bits[body, k]), int(near.bits[body, k + source]), 4)
    ways = near.ways
    copy_vector(ways.qpos, ways.last_qpos)
    copy_vector(ways.mocap_pos, ways.last_pos)
    copy_vector(ways.mocap_quat, ways.last_quat)
    ways.allowed[0] = allowed


@compiled
def leave_out(near: Clearances, now: float) -> int:
    """Let the model be without the bodies that cannot touch anything, if the last look is still good."""
    if measure_way(near.ways) < near.ways.allowed[0]:
        copy_pieces(near.fewer)
    else:
        near.ways.allowed[0] = 0.0
    return 0


@compiled
def take_in(near: Clearances, now: float) -> int:
    """Let the model have all bodies again, and look if that is due."""
    copy_pieces(near.every)
    if near.ways.allowed[0] == 0.0:
        look(near)
    return 0


class FarBodies:
    """What is left out of the search for contacts of a model; later its geoms may only have less contact bits.

    `leave_out` and `take_in` are to be called before and after each search; at all other times the model has all.
    """

    def __init__(self, model: Any, data: Any) -> None:
        self._model, self._allowed = model, np.zeros(1)
        self._joints, self._mocap_levers = np.zeros((model.njnt, 5)), np.zeros(model.nmocap)
        self._boxes, self._pairs = np.zeros((model.ngeom, SHAPE + 1)), find_pairs(model)
        ways = Ways(
            self._joints, self._mocap_levers, data.qpos, data.mocap_pos.ravel(), data.mocap_quat.ravel(),
            np.zeros(model.nq), np.zeros(3 * model.nmocap), np.zeros(4 * model.nmocap), self._allowed,
        )  # fmt: skip
        here = (model.body_contype, model.body_conaffinity)
        every = np.array(here, dtype=np.int32)
        fewer, zero = every.copy(), np.zeros(1, dtype=np.int32)
        self._kept = every, fewer, zero
        bits = [
            [_address(each) for kind in (0, 1) for each in (fewer[kind, body:], every[kind, body:], zero)]
            for body in range(model.nbody)
        ]
        self.clearances = near = Clearances(
            ways, self._pairs, self._boxes, data.geom_xpos, data.geom_xmat, np.zeros((model.ngeom, 3)),
            np.zeros(model.nbody), _copies(here, fewer), _copies(here, every), np.array(bits, dtype=np.float64),
        )  # fmt: skip
        self.leave_out, self.take_in = bind(leave_out, near), bind(take_in, near)
        self.renew()

    def renew(self) -> None:
        """Take over what was changed in the model since it was built, and look again after the next search."""
        model = self._model
        self._joints[:] = np.array([*find_joints(model)]).reshape(-1, 5)
        self._mocap_levers[:] = find_mocap_levers(model)
        self._boxes[:, :6], self._boxes[:, 6] = model.geom_aabb, np.linalg.norm(model.geom_aabb[:, 3:], axis=1)
        self._boxes[:, SHAPE] = find_shapes(model)
        geoms, margins = self._pairs[:, :2].astype(int), model.geom_margin + model.geom_gap
        self._pairs[:, 4] = margins[geoms].sum(axis=1)
        self._allowed[0] = 0.0


def make_far_bodies(model: Any, data: Any) -> FarBodies | None:
    """Return what can be left out of a model; None if functions are not compiled, or its levers are not known."""
    joints = set(model.jnt_type.tolist()) <= KNOWN_JOINTS
    planes = model.geom_bodyid[model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE]
    return FarBodies(model, data) if COMPILES and joints and not model.body_weldid[planes].any() else None


def _copies(targets: tuple[Any, Any], sources: NDArray[np.int32]) -> Copies:
    pieces = [(_address(to), _address(source), source.nbytes) for to, source in zip(targets, sources, strict=True)]
    return Copies(np.array(pieces, dtype=np.float64))


def _address(array: Any) -> int:
    return int(array.__array_interface__["data"][0])
