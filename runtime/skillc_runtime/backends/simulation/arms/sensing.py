"""The measurements of a simulated arm: joints, tool centre point, Jacobian, payload and wrench, in its base frame."""

from __future__ import annotations

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.arms.geometry_errors import GeometryErrors, measure_joint, misjudge_tool
from skillc_runtime.motion.arrays import Integers, Matrix, OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import cross, product, times, transposed_times
from skillc_runtime.motion.numerics.places import call_entry
from skillc_runtime.motion.pose import Array, Pose

TOOL = 6
"""The row of the tool centre point."""

LEVER = 7
"""The row of the vector from there to the payload's centre of mass."""

MEASURED_AT, MASS_DUE, TARED_AT = range(3)
"""Entries of `ArmSensing.times`, s: of the last measurement, when the mass matrix has to be computed again, and when
the sensor was tared."""

NOT_READY = 1 << 32
"""The bit of measurements that have not been made, since Python has something to do first."""

MASS_MATRIX_PERIOD_S = 0.01
"""Period with which the mass matrix, which changes slowly, is computed."""

Q, SPEED, BIAS, CARRYING, EFFORT, BEFORE, WAVE = range(7)
"""Rows of the joint measurements; CARRYING: the torques that carry a payload; BEFORE: the speeds before, exact; WAVE:
rad, what encoders measure more than is so."""


class LastLink:
    """Tool centre point, wrist axes and payload of an arm; all arrays are reused.

    tool: the tool centre point; lever (3,): from there to the payload's centre of mass; in the arm's base frame, as of
    the last call of `update_hand`. `on_link` and `in_base` hold all of it, and the wrist's axes, one vector a row.
    """

    def __init__(self) -> None:
        self.on_link, self.in_base, self.rotation = np.zeros((8, 3)), np.zeros((8, 3)), np.zeros((3, 3))
        self.tool = Pose(self.in_base[TOOL], self.rotation)
        self.lever = self.in_base[LEVER]

    def configure(self, tool: Pose, wrist: Array, payload: Array) -> None:
        """Set the tool centre point, the wrist's axes (3, 3) and the payload's centre (3,) m, in the link's frame."""
        self.on_link[:3], self.on_link[3:6] = tool.rotation.T, wrist.T
        self.on_link[TOOL], self.on_link[LEVER] = tool.position, payload - tool.position


@inlined
def add_payload_bias(
    bias: OutVector, carrying: OutVector, weight: Vector, base_rotation: Matrix, lever: Vector, J: Matrix
) -> None:
    """Add to `bias` (nv,) the torques that carry a payload: J^T [w; r x w], w = -m g, at r from the tool centre."""
    load = np.empty(6)
    transposed_times(base_rotation, weight, load[:3])
    cross(lever, load[:3], load[3:])
    transposed_times(J, load, carrying)
    for j in range(bias.size):
        bias[j] += carrying[j]


@inlined
def compute_wrench(
    wrench: OutVector, gain: Matrix, readings: Vector, zero: Matrix, tared_s: float, axes: Matrix
) -> None:
    """wrench (6,) = gain (6, 9) readings (9,) - zero[0] - zero[1] tared_s, its halves along `axes` (3, 3), one a row.

    zero (2, 6): N and N m, and by how much that drifts in a second; tared_s: s since it was so.
    """
    at_wrist = np.empty(6)
    times(gain, readings, at_wrist)
    for i in range(6):
        at_wrist[i] -= zero[0, i] + zero[1, i] * tared_s
    transposed_times(axes, at_wrist[:3], wrench[:3])
    transposed_times(axes, at_wrist[3:], wrench[3:])


class ArmSensing(msgspec.Struct, frozen=True):
    """The inputs and outputs of `measure` for one arm; all arrays are reused or change with the simulation.

    Written, in the arm's base frame. joints (7, nv): Q and WAVE rad, SPEED and BEFORE rad/s, others N m; in_base (8,
    3): see `LastLink`; rotation (3, 3), jacobian (6, nv): of the tool centre point, [linear m; angular rad] per rad;
    wrench (6,): N and N m on the tool, zeros without sensor; velocity (3,): m/s, of the tool centre point. times (3,):
    see above.

    Read. q, dq, bias (nv,): rad, rad/s and N m, without noise and payload; modelled: by what the arm's model multiplies
    the bias; correction, effort_bias (nv,): N m, what is added to that, and what torque sensors add; on_link (8, 3): as
    there. In the world:
    motion_axes (nv, 6), MuJoCo's `cdof`, and centre (3,) m, where they hold; position (3,) m and rotation (3, 3) of
    last link and base; weight (3,) N of the payload. actuators, applied, passive (nv,): N m, in the last step, in which
    the servos' damping (nv,), N m s/rad, also acts on the change of the speeds. gain (6, 9) and readings (9,): of the
    sensor, see `Wrist`; zero (2, 6): see `compute_wrench`. noise (n, nv): rad/s, a row for each measurement, of
    which `used` (1,) are used up. geometry: what the arm does not know of its links and joints.
    """

    joints: OutMatrix
    in_base: OutMatrix
    rotation: OutMatrix
    jacobian: OutMatrix
    wrench: OutVector
    velocity: OutVector
    q: Vector
    dq: Vector
    bias: Vector
    modelled: float
    correction: Vector
    effort_bias: Vector
    on_link: Matrix
    motion_axes: Matrix
    centre: Vector
    link: Pose
    base: Pose
    weight: Vector
    actuators: Vector
    applied: Vector
    passive: Vector
    damping: Vector
    gain: Matrix
    readings: Vector
    zero: Matrix
    noise: Matrix
    used: OutVector
    times: OutVector
    geometry: GeometryErrors


@inlined
def update_hand(arm: ArmSensing) -> None:
    """Compute, in base axes, the vectors of the last link and the Jacobian (6, nv) of the tool centre point.

    motion_axes: [angular; linear] velocity at `centre` per joint speed. With d = tool - centre and base axes a_i:
    a_i . (v + w x d) = a_i . v + (d x a_i) . w.
    """
    in_world, away, at_tool, axes = np.empty((8, 3)), np.empty(3), np.zeros((6, 6)), arm.base.rotation
    product(arm.on_link, arm.link.rotation.T, in_world)
    for i in range(3):
        in_world[TOOL, i] += arm.link.position[i]
        away[i] = in_world[TOOL, i] - arm.centre[i]
        in_world[TOOL, i] -= arm.base.position[i]
        for j in range(3):
            at_tool[i, 3 + j] = at_tool[3 + i, j] = axes[j, i]
    product(in_world, axes, arm.in_base)
    for i in range(3):
        for j in range(3):
            arm.rotation[i, j] = arm.in_base[j, i]
        cross(away, at_tool[i, 3:], at_tool[i, :3])
    product(at_tool, arm.motion_axes.T, arm.jacobian)


@compiled
def measure(arm: ArmSensing, now: float) -> int:
    """Compute the measurements at `now` s: hand, Jacobian, velocity, wrench, bias with payload, speeds with noise.

    Return `NOT_READY`, and compute nothing, if all noise is used up.
    """
    joints, J, axes, row = arm.joints, arm.jacobian, arm.base.rotation, int(arm.used[0])
    if row == arm.noise.shape[0]:
        return NOT_READY
    arm.used[0] += 1.0
    arm.times[MEASURED_AT] = now
    update_hand(arm)
    for j in range(arm.q.size):
        q, dq = measure_joint(arm.geometry, j, arm.q[j], arm.dq[j])
        joints[Q, j], joints[SPEED, j] = q, dq + arm.noise[row, j]
        joints[WAVE, j] = q - arm.q[j]
        joints[BIAS, j] = arm.modelled * arm.bias[j] + arm.correction[j]
        exerted = arm.actuators[j] + arm.applied[j] + arm.passive[j]
        joints[EFFORT, j] = exerted + arm.effort_bias[j] - arm.damping[j] * (arm.dq[j] - joints[BEFORE, j])
        joints[BEFORE, j] = arm.dq[j]
    misjudge_tool(arm.geometry, arm.base, joints[WAVE], J, arm.in_base[TOOL], arm.rotation)
    add_payload_bias(joints[BIAS], joints[CARRYING], arm.weight, axes, arm.in_base[LEVER], J)
    compute_wrench(arm.wrench, arm.gain, arm.readings, arm.zero, now - arm.times[TARED_AT], arm.in_base[3:6])
    times(J[:3], joints[SPEED], arm.velocity)
    return 0


@inlined
def add_payload_mass(mass: OutMatrix, lever: Vector, J: Matrix, payload_kg: float) -> None:
    """Add to a mass matrix (nv, nv) that of a point payload: m J_c^T J_c with J_c = J_v - lever x J_w."""
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


class MassMemory(msgspec.Struct, frozen=True):
    """The mass matrix (nv, nv) of an arm, in kg m^2, and what it is computed from.

    whole (n, n): of all joints of the model, of which those of the arm begin at number `first`. compute (m, 4): see
    `WholeMass.calls`; payload (1,): kg; times (3,), lever (3,), jacobian (6, nv): of `ArmSensing`.
    """

    mass: OutMatrix
    whole: OutMatrix
    first: float
    compute: Integers
    payload: Vector
    times: OutVector
    lever: Vector
    jacobian: Matrix


@inlined
def _take_mass(memory: MassMemory, now: float) -> None:
    mass, first = memory.mass, int(memory.first)
    for i in range(mass.shape[0]):
        for j in range(mass.shape[1]):
            mass[i, j] = memory.whole[first + i, first + j]
    if memory.payload[0] > 0.0:
        add_payload_mass(mass, memory.lever, memory.jacobian, memory.payload[0])
    memory.times[MASS_DUE] = now + MASS_MATRIX_PERIOD_S - 1e-9


@compiled
def take_mass(memory: MassMemory, now: float) -> None:
    """Take the mass matrix of the arm, with its payload, from that of the whole model, computed at `now` s."""
    _take_mass(memory, now)


@compiled
def update_mass(memory: MassMemory, now: float) -> int:
    """Compute the mass matrix if it is due at `now` s; for machine code."""
    if now >= memory.times[MASS_DUE]:
        for each in range(memory.compute.shape[0]):
            function, model, data, whole = memory.compute[each]
            if function != 0:
                call_entry(function, model, data, whole)
        _take_mass(memory, now)
    return 0
