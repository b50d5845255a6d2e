"""What is fixed to an arm's last link, seen from the arm's base, and how it moves with the joints."""

from __future__ import annotations

import numpy as np

from skillc_runtime.motion.numerics.compiled import Matrix, OutMatrix, OutVector, Vector, compiled, part
from skillc_runtime.motion.numerics.linear import cross, product, times, transposed_times
from skillc_runtime.motion.pose import Array, Pose

TOOL = 6
"""The row of the tool centre point."""

LEVER = 7
"""The row of what leads from there to the payload's centre of mass."""

Q, SPEED, BIAS, CARRYING = range(4)
"""Rows of what is measured at the joints; the last are the torques that carry a payload."""


class Hand:
    """Tool centre point, wrist axes and payload of an arm; all arrays are reused.

    tool: the tool centre point; lever (3,): from there to the payload's centre of mass; in the arm's base frame, as of
    the last call of `see_hand`. `on_link` and `in_base` hold all of it, and the wrist's axes, one vector a row.
    """

    def __init__(self) -> None:
        self.on_link, self.in_base = np.zeros((8, 3)), np.zeros((8, 3))
        self.tool = Pose(self.in_base[TOOL], self.in_base[:3].T)
        self.lever = self.in_base[LEVER]

    def hold(self, tool: Pose, wrist: Array, payload: Array) -> None:
        """Take the tool centre point, the wrist's axes (3, 3) and the payload's centre (3,), in the link's frame."""
        self.on_link[:3], self.on_link[3:6] = tool.rotation.T, wrist.T
        self.on_link[TOOL], self.on_link[LEVER] = tool.position, payload - tool.position


@part
def see_hand(
    in_base: OutMatrix,
    J: OutMatrix,
    on_link: Matrix,
    motion_axes: Matrix,
    centre: Vector,
    link_position: Vector,
    link_rotation: Matrix,
    base_position: Vector,
    base_rotation: Matrix,
) -> None:
    """Compute, in base axes, what is on the link, and the Jacobian J (6, nv) of the tool centre point.

    motion_axes (nv, 6): MuJoCo's `cdof`, [angular; linear] velocity at `centre` (3,) per joint speed, in the world.
    With d = tool - centre and base axes a_i: a_i . (v + w x d) = a_i . v + (d x a_i) . w.
    """
    in_world, away, at_tool = np.empty((8, 3)), np.empty(3), np.zeros((6, 6))
    product(on_link, link_rotation.T, in_world)
    for i in range(3):
        in_world[TOOL, i] += link_position[i]
        away[i] = in_world[TOOL, i] - centre[i]
        in_world[TOOL, i] -= base_position[i]
        for j in range(3):
            at_tool[i, 3 + j] = at_tool[3 + i, j] = base_rotation[j, i]
    product(in_world, base_rotation, in_base)
    for i in range(3):
        cross(away, at_tool[i, 3:], at_tool[i, :3])
    product(at_tool, motion_axes.T, J)


@part
def carry(
    bias: OutVector, carrying: OutVector, weight: Vector, base_rotation: Matrix, lever: Vector, J: Matrix
) -> None:
    """Add to `bias` (nv,) what carries a payload: J^T [w; r x w], w = -m g, in the world, at r from the tool centre."""
    load = np.empty(6)
    transposed_times(base_rotation, weight, load[:3])
    cross(lever, load[:3], load[3:])
    transposed_times(J, load, carrying)
    for j in range(bias.size):
        bias[j] += carrying[j]


@part
def external_wrench(wrench: OutVector, gain: Matrix, readings: Vector, axes: Matrix) -> None:
    """wrench (6,) = gain (6, 9) readings (9,), its halves along `axes` (3, 3), one a row."""
    at_wrist = np.empty(6)
    times(gain, readings, at_wrist)
    transposed_times(axes, at_wrist[:3], wrench[:3])
    transposed_times(axes, at_wrist[3:], wrench[3:])


@compiled
def measure(
    joints: OutMatrix,
    in_base: OutMatrix,
    J: OutMatrix,
    wrench: OutVector,
    true_q: Vector,
    true_dq: Vector,
    own_bias: Vector,
    noise: Vector,
    on_link: Matrix,
    motion_axes: Matrix,
    centre: Vector,
    link_position: Vector,
    link_rotation: Matrix,
    base_position: Vector,
    base_rotation: Matrix,
    weight: Vector,
    gain: Matrix,
    readings: Vector,
) -> None:
    """Compute what an arm measures: hand and Jacobian; speeds with their noise, bias with that of a payload; wrench.

    joints (4, nv); gain (6, 9) and readings (9,): of the sensor at the wrist, see there.
    """
    see_hand(
        in_base, J, on_link, motion_axes, centre, link_position, link_rotation, base_position, base_rotation
    )  # fmt: skip
    for j in range(true_q.size):
        joints[Q, j], joints[SPEED, j], joints[BIAS, j] = true_q[j], true_dq[j] + noise[j], own_bias[j]
    carry(joints[BIAS], joints[CARRYING], weight, base_rotation, in_base[LEVER], J)
    external_wrench(wrench, gain, readings, in_base[3:6])


@compiled
def load_mass(mass: OutMatrix, lever: Vector, J: Matrix, payload_kg: float) -> None:
    """Add to a mass matrix (nv, nv) that of a payload as a point: m J_c^T J_c with J_c = J_v - lever x J_w."""
    joints = J.shape[1]
    at_centre, moved, spun = np.empty((3, joints)), np.empty(3), np.empty((joints, joints))
    for j in range(joints):
        cross(J[3:, j], lever, moved)
        for i in range(3):
            at_centre[i, j] = J[i, j] + moved[i]
    product(at_centre.T, at_centre, spun)
    for i in range(joints):
        for j in range(joints):
            mass[i, j] += payload_kg * spun[i, j]
