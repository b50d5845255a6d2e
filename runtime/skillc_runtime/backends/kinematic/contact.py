"""Ideal contact: where what an arm carries overlaps with something, a spring pushes it out; there is no friction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skillc_runtime.motion.arrays import Matrix, OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import cross
from skillc_runtime.motion.pose import Array

RIGID_N_M = 5000.0
"""Stiffness of a contact point of fingers and of rigid tools."""

DAMPING_S_M = 10.0
"""Share of the spring's force by which it grows with the speed of indentation, in 1/(m/s)."""

FINGERS, TOOL = 0, 1
"""The carriers of arm i, 2 i + this: its fingers, and the tool that they hold."""

FIXED, FREE = -1, -2
"""Marks geoms that no arm carries: those that all touch, and things that lie free, which fingers only grip."""


@dataclass(frozen=True, slots=True)
class Points:
    """The overlaps of this step, in the world: distance (n,) m, negative if they overlap; place (n, 3) m.

    normal (n, 9): from the first to the second geom, then tangents; geoms (n, 2): their numbers.
    """

    distance: Vector
    normal: Matrix
    place: Matrix
    geoms: Matrix


@dataclass(frozen=True, slots=True)
class Motion:
    """The motion of the last links of all arms, and of what yields, in the world; arrays change with the cell.

    links (a, 2): the bodies of the last link and of the root of each arm. Of all bodies: twist (bodies, 6) [angular
    rad/s; linear m/s], which holds at the centre (bodies, 3) in m of the root. tool (a, 3): m, the tool centre points;
    axis, anchor (j, 3): of joints of fixtures, anchor in m. slides (j,): 1 if it slides, 0 if it turns; moves (j,
    geoms): 1 if the joint moves a geom, else 0.
    """

    links: Matrix
    twist: Matrix
    centre: Matrix
    tool: OutMatrix
    axis: OutMatrix
    anchor: OutMatrix
    slides: Vector
    moves: Matrix


@dataclass(frozen=True, slots=True)
class Forces:
    """The result, for a arms: wrench (a, 6), N and N m of the surroundings at the tool centre point, world axes.

    on_geom (2 a * geoms, 3): N, of a carrier on a geom, in the world; net (2 a, 3): N, of a carrier on all geoms; total
    (2 a,): N, the sum of all normal forces on a carrier. joint (j, 2): N or N m along each joint of a fixture, and the
    stiffness of the contacts along it.
    """

    wrench: OutMatrix
    on_geom: OutMatrix
    net: OutMatrix
    total: OutVector
    joint: OutMatrix


def make_forces(arms: int, geoms: int, joints: int) -> Forces:
    """Return forces that are zero."""
    net, total = np.zeros((2 * arms, 3)), np.zeros(2 * arms)
    return Forces(np.zeros((arms, 6)), np.zeros((2 * arms * geoms, 3)), net, total, np.zeros((joints, 2)))


@inlined
def along_joint(motion: Motion, joint: int, place: Array, normal: Array) -> float:
    """Return how far a point (3,) m of a fixture moves along a direction (3,) per m or rad of a joint."""
    arm, moved = np.empty(3), np.empty(3)
    for i in range(3):
        arm[i] = place[i] - motion.anchor[joint, i]
    cross(motion.axis[joint], arm, moved)
    along = 0.0
    for i in range(3):
        along += normal[i] * (motion.axis[joint, i] if motion.slides[joint] > 0.0 else moved[i])
    return along


@inlined
def leaving_speed(motion: Motion, arm: int, theirs: int, place: Array, normal: Array) -> float:
    """Return the speed in m/s of a point (3,) m of an arm along the normal (3,) of a geom; 0 if that yields.

    What yields has dampers of its own.
    """
    link, root = int(motion.links[arm, 0]), int(motion.links[arm, 1])
    lever, turning, speed = np.empty(3), np.empty(3), 0.0
    for i in range(3):
        lever[i] = place[i] - motion.centre[root, i]
    cross(motion.twist[link, :3], lever, turning)
    for i in range(3):
        speed += normal[i] * (motion.twist[link, 3 + i] + turning[i])
    for j in range(motion.slides.size):
        speed *= 1.0 - motion.moves[j, theirs]
    return speed


@inlined
def add_force(forces: Forces, motion: Motion, carrier: int, theirs: int, place: Array, force: Array) -> None:
    """Add a force (3,) in N on a carrier at a place (3,) in m, from a geom; all in the world."""
    arm, row, lever, moment = carrier // 2, carrier * motion.moves.shape[1] + theirs, np.empty(3), np.empty(3)
    for i in range(3):
        lever[i] = place[i] - motion.tool[arm, i]
    cross(lever, force, moment)
    for i in range(3):
        forces.wrench[arm, i] += force[i]
        forces.wrench[arm, 3 + i] += moment[i]
        forces.on_geom[row, i] -= force[i]
        forces.net[carrier, i] -= force[i]
    for j in range(motion.slides.size):
        forces.joint[j, 0] -= motion.moves[j, theirs] * along_joint(motion, j, place, force)


@inlined
def clear(forces: Forces) -> None:
    """Set all forces to zero."""
    for array in (forces.wrench, forces.on_geom, forces.net, forces.joint):
        for i in range(array.shape[0]):
            for j in range(array.shape[1]):
                array[i, j] = 0.0
    for i in range(forces.total.size):
        forces.total[i] = 0.0


@compiled
def compute_contacts(forces: Forces, points: Points, motion: Motion, carrier: Vector, stiffness: Vector) -> None:
    """Set the forces to sums of F = k d (1 + c dd/dt), one for each overlap d of what is carried with what is fixed.

    carrier (geoms,): the carrier of each geom, or `FIXED` or `FREE`; stiffness (2 a,): k of each carrier, N/m. Hunt and
    Crossley 1975, with exponent 1.
    """
    clear(forces)
    normal, force = np.empty(3), np.empty(3)
    for n in range(points.distance.size):
        first, second = int(points.geoms[n, 0]), int(points.geoms[n, 1])
        ours, theirs, sign = (first, second, -1.0) if carrier[first] >= 0.0 else (second, first, 1.0)
        who, place = int(carrier[ours]), points.place[n]
        if points.distance[n] >= 0.0 or who < 0 or carrier[theirs] >= 0.0:
            continue
        if who % 2 == FINGERS and carrier[theirs] != FIXED:
            continue
        for i in range(3):
            normal[i] = sign * points.normal[n, i]
        leaving = leaving_speed(motion, who // 2, theirs, place, normal)
        newton = max(0.0, -stiffness[who] * points.distance[n] * (1.0 - DAMPING_S_M * leaving))
        for i in range(3):
            force[i] = newton * normal[i]
        forces.total[who] += newton
        add_force(forces, motion, who, theirs, place, force)
        for j in range(motion.slides.size):
            along = motion.moves[j, theirs] * along_joint(motion, j, place, normal)
            forces.joint[j, 1] += stiffness[who] * along * along
