"""A gripper without physics: its fingers stop at what they touch, and hold it until they let go."""

from __future__ import annotations

from typing import Any

import numpy as np

from skillc_runtime.backends.simulation.arms.arm import ModelledArm
from skillc_runtime.backends.simulation.checkpoint import SavedGrip
from skillc_runtime.backends.simulation.contacts import Contacts
from skillc_runtime.backends.simulation.hands.finger_sensor import FingerSensor
from skillc_runtime.backends.simulation.hands.gripper import ModelledGripper
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import GripperSpec, ToolSpec
from skillc_runtime.motion.arrays import OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import cross
from skillc_runtime.motion.pose import Array, Pose, quaternion_from_rotation
from skillc_runtime.world.space.bodies import RigidBody


class KinematicGripper(ModelledGripper):
    """One gripper of a kinematic cell; what it holds moves with its palm and does not slip."""

    _opening: float
    _free_position: Array
    _free_speed: Array

    def __init__(
        self,
        facts: GripperSpec,
        names: dict[str, str],
        things: tuple[ToolSpec | RigidBody, ...],
        arm: ModelledArm,
        model: Any,
        data: Any,
        contacts: Contacts,
    ) -> None:
        super().__init__(facts, names, things, arm, model, data, contacts, FingerSensor())
        self._held_in_palm = np.zeros(7)

    @property
    def _true_opening_m(self) -> float:
        """The true distance between the fingers in m."""
        return self._opening

    @property
    def _finger_force_n(self) -> None:
        """Forces are not computed."""

    def contact_force(self) -> None:
        """Forces are not computed."""

    def move(self, opening_m: float, force_n: float) -> None:
        """Move the fingers to an opening in m, limited to that of the gripper; the force in N has no effect."""
        self._goal = min(max(opening_m, 0.0), self._facts.max_opening_m)
        self._idle = self._goal == self._opening

    def stop(self) -> None:
        """Stop the fingers at their present opening."""
        self._goal, self._idle = self._opening, True

    def step(self, period_s: float) -> None:
        """Move the fingers by one step; closing fingers stop at what they touch from opposite sides."""
        if self._idle:
            return
        if self._goal < self._opening and any(map(self.touches, self._things)):
            self.stop()
            return
        way = self._facts.finger_speed_m_s * period_s
        self._set_fingers(self._opening + min(max(self._goal - self._opening, -way), way))
        self._idle = self._opening == self._goal

    def move_held(self, centre: Array, twist: Array) -> None:
        """Place a held object in the palm; twist (6,): of the palm, [angular; linear] at `centre` (3,) in the world."""
        in_palm, data, palm = self._held_in_palm, self._data, self._palm
        place_held(self._free_position, self._free_speed, in_palm, data.xpos[palm], data.xquat[palm], centre, twist)

    def _hold(self, thing: str, in_palm: Pose, grip: SavedGrip | None) -> None:
        self._held_in_palm[:3], self._held_in_palm[3:] = in_palm.position, quaternion_from_rotation(in_palm.rotation)
        free = self._model.joint(part_name(self._names[thing], "free"))
        self._free_position = self._data.qpos[free.qposadr[0] : free.qposadr[0] + 7]
        self._free_speed = self._data.qvel[free.dofadr[0] : free.dofadr[0] + 6]

    def _let_go(self, thing: str) -> None:
        """Leave the object where it is, at rest."""
        self._free_speed[:] = 0.0

    def _save_grip(self) -> None:
        """A grasp holds."""

    def _restore_fingers(self, opening_m: float, force_n: float) -> None:
        """Let the fingers rest at an opening in m; the force in N has no effect."""
        self._set_fingers(opening_m)
        self._goal = opening_m

    def _is_at_force_limit(self) -> bool:
        """Return whether the fingers were stopped by what they touch, or by what they hold."""
        return bool(self._carried) or any(map(self.touches, self._things))

    def _set_fingers(self, opening_m: float) -> None:
        super()._set_fingers(opening_m)
        self._opening = opening_m


@compiled
def place_held(
    position: OutVector, speed: OutVector, in_palm: Vector, palm: Vector, turn: Vector, centre: Vector, twist: Vector
) -> None:
    """Set position (7,) and speed (6,) of a free joint whose frame is at in_palm (7,) in the palm; m and quaternions.

    palm (3,) m and turn (4,): the palm in the world. twist (6,): [angular rad/s; linear m/s] at centre (3,) m. The
    speed is linear in m/s in the world, and angular in rad/s along the axes of the object.
    """
    away, arm, spin = np.empty(3), np.empty(3), np.empty(4)
    rotate(turn, in_palm[:3], away)
    multiply(turn, in_palm[3:], position[3:])
    for i in range(3):
        position[i] = palm[i] + away[i]
        arm[i] = position[i] - centre[i]
    cross(twist[:3], arm, away)
    for i in range(4):
        spin[i] = position[3 + i] if i == 0 else -position[3 + i]
    rotate(spin, twist[:3], arm)
    for i in range(3):
        speed[i], speed[3 + i] = twist[3 + i] + away[i], arm[i]


@inlined
def multiply(a: Array, b: Array, out: Array) -> None:
    """out (4,) = a b, quaternions (4,) with w first."""
    out[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3]
    out[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2]
    out[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1]
    out[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]


@inlined
def rotate(turn: Array, vector: Array, out: Array) -> None:
    """out (3,) = v + 2 w (u x v) + 2 u x (u x v), a vector (3,) rotated by a unit quaternion (4,) = (w, u)."""
    once, twice = np.empty(3), np.empty(3)
    cross(turn[1:], vector, once)
    cross(turn[1:], once, twice)
    for i in range(3):
        out[i] = vector[i] + 2.0 * (turn[0] * once[i] + twice[i])
