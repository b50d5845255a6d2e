"""A simulated gripper: a servo for the opening; contact from opposite sides is a grasp.

A weld holds the object, since friction grasps creep in rigid-body simulation, as long as friction could carry the load
on the weld; the physics then makes it a part of the hand. After that only contact and friction hold it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.mujoco.grip import IS_DUE, SLIPS, Grip, make_grip
from skillc_runtime.backends.mujoco.physics import Physics
from skillc_runtime.backends.simulation.arms.arm import ModelledArm
from skillc_runtime.backends.simulation.bases.base import BaseStep
from skillc_runtime.backends.simulation.checkpoint import SavedGrip
from skillc_runtime.backends.simulation.hands.finger_sensor import make_finger_sensor
from skillc_runtime.backends.simulation.hands.gripper import ModelledGripper
from skillc_runtime.backends.simulation.hands.loss_watch import LossWatch, may_be_lost
from skillc_runtime.backends.simulation.names import part_name, weld_name
from skillc_runtime.backends.simulation.scene_spec import GripperSpec, ToolSpec
from skillc_runtime.devices.reality import NO_SIZES
from skillc_runtime.motion.numerics.compiled import Bound, bind
from skillc_runtime.motion.pose import Array, Pose, quaternion_from_rotation
from skillc_runtime.world.space.bodies import RigidBody


def pressing_force(model: Any, data: Any, roots: Sequence[int]) -> Array:
    """Return the force (3,) in N, world axes, with which bodies and what is fixed below them press on the rest.

    roots: ids of the bodies. A person who leads a hand touches nothing in the simulation, and does not count.
    """
    inside = np.zeros(model.nbody, dtype=bool)
    inside[list(roots)] = True
    for body in range(1, model.nbody):  # parents stand before their children
        inside[body] |= inside[model.body_parentid[body]]
    total, wrench = np.zeros(3), np.zeros(6)
    touching = inside[model.geom_bodyid[data.contact.geom]] if data.ncon else np.zeros((0, 2), dtype=bool)
    for contact in np.flatnonzero(touching[:, 0] != touching[:, 1]):
        mujoco.mj_contactForce(model, data, int(contact), wrench)
        force = data.contact.frame[contact].reshape(3, 3).T @ wrench[:3]  # of the first body on the second
        total += force if touching[contact, 0] else -force
    return np.asarray(total)


STILL_M_S, STILL_TIME_S = 0.002, 0.05
"""Fingers that have been slower than this for this time, at their goal or blocked, have arrived."""


class SimulatedGripper(ModelledGripper):
    """One gripper of a simulated cell; contact is required for a grasp, a weld holds it."""

    def __init__(
        self,
        facts: GripperSpec,
        names: dict[str, str],
        things: tuple[ToolSpec | RigidBody, ...],
        arm: ModelledArm,
        physics: Physics,
        seed: int,
    ) -> None:
        model, data, self._physics = physics.model, physics.data, physics
        sensor = make_finger_sensor(facts, seed)
        super().__init__(facts, names, things, arm, model, data, physics.contacts, sensor)
        self._palm_axes: Array = data.xmat[self._palm].reshape(3, 3)
        self._length = data.actuator_length[self._actuator : self._actuator + 1]
        self._speed = data.actuator_velocity[self._actuator : self._actuator + 1]
        self._data.ctrl[self._actuator] = self._target = self._goal
        self._still_since, self._limit_n = 0.0, float(model.actuator_forcerange[self._actuator, 1])
        self._grip: Grip | None = None
        self.may_be_lost = bind(
            may_be_lost, LossWatch(self._sensor.opening, self._length, self._held, model.opt.timestep)
        )

    @property
    def _true_opening_m(self) -> float:
        """The true distance between the fingers in m."""
        return float(self._length[0])

    @property
    def _finger_force_n(self) -> float:
        """The force in N of the closing motor; of what the weld holds, that with which it was grasped."""
        motor = max(0.0, -float(self._data.actuator_force[self._actuator]))
        return motor if self._grip is None else self._grip.force_n

    def contact_force(self) -> Array:
        """Return the force (3,) in N, world axes, with which hand and held object press on the rest, added up.

        It is computed for a copy of the present state: between steps the simulation has new contacts, and the forces of
        the old ones.
        """
        roots, physics = [self._palm], self._physics
        if self._carried:
            roots.append(self._model.body(part_name(self._names[self._carried], "block")).id)
        present = mujoco.MjData(physics.contacts.model)
        mujoco.mj_copyData(present, physics.contacts.model, physics.contacts.data)
        mujoco.mj_forward(physics.contacts.model, present)
        return pressing_force(physics.contacts.model, present, physics.find_bodies(roots))

    def move(self, opening_m: float, force_n: float) -> None:
        """Move the fingers to an opening in m with at most a force in N, both limited to those of the gripper."""
        self._physics.release(self._carried)
        self._limit(min(force_n, self._facts.max_force_n))
        self._goal = min(max(opening_m, 0.0), self._facts.max_opening_m)
        self._target, self._idle, self._still_since = self._true_opening_m, False, self._data.time

    def stop(self) -> None:
        """Stop the fingers at their present opening."""
        self._goal = self._target = self._true_opening_m
        self._data.ctrl[self._actuator] = self._target
        self._rest()

    def step(self, period_s: float) -> None:
        """Advance the servo's target by one step."""
        if self._idle:
            return
        way = self._facts.finger_speed_m_s * period_s
        self._target += min(max(self._goal - self._target, -way), way)
        self._data.ctrl[self._actuator] = self._target
        if abs(self._speed[0]) > STILL_M_S:
            self._still_since = self._data.time
        elif self._data.time - self._still_since > STILL_TIME_S:
            arrived = abs(self._true_opening_m - self._goal) < STILL_M_S
            if arrived or self._target == self._goal or self._is_at_force_limit():
                self._rest()

    def _rest(self) -> None:
        """Let the fingers stand still: a tool that they hold firmly is a part of the hand until they move again."""
        self._idle = True
        if self._carried and self._is_firm():
            self._physics.hold(self._carried, self.individual)

    def _is_firm(self) -> bool:
        """Whether a tool with a soft face is carried, and friction bears its true weight.

        What is rigid meets others through the pads of the fingers, for which the weld yields; and what friction does
        not bear will slip, which the weld shows better.
        """
        thing = self._things[self._carried]
        if not isinstance(thing, ToolSpec) or thing.rigid:
            return False
        block = self._model.body(part_name(self._names[self._carried], "block")).id
        weight_n = float(self._model.body_subtreemass[block] * np.linalg.norm(self._model.opt.gravity))
        return self._grip is not None and weight_n <= self._grip.bears_n

    @property
    def load_watch(self) -> Bound[[float], int] | None:
        """What looks at the load on a grasp in each step; None without one. `loses` says what its bits mean."""
        if self._grip is None:
            return None
        pull = self._physics.pull_on(self._carried)
        return self._grip.is_due if pull is None else self._grip.watch(self._palm_axes, pull)

    @property
    def needs_base_motion(self) -> bool:
        """Whether it carries an object that is no part of the hand."""
        return super().needs_base_motion and self._physics.pull_on(self._carried) is None

    def move_with_base(self, step: BaseStep) -> None:
        """Move a carried object with the base of the arm, unless it is a part of the hand, with which it moves."""
        if self.needs_base_motion:
            super().move_with_base(step)

    def loses(self, events: int, now: float) -> bool:
        """Tell whether more pulls at the carried object than friction bears, of what looking at the load has found.

        To be called between `mj_step2` and the next `mj_step1`.
        """
        if events == IS_DUE and self._grip is not None:
            return self._grip.slips(now, self._palm_axes, self._pull_of_weld())
        return events == SLIPS

    def _limit(self, force_n: float) -> None:
        """Limit the force of the fingers."""
        self._limit_n, self._model.actuator_forcerange[self._actuator] = force_n, (-force_n, force_n)

    def _hold(self, thing: str, in_palm: Pose, grip: SavedGrip | None) -> None:
        """Activate the weld."""
        equality = self._weld(thing)
        if grip is None:
            force = abs(float(self._data.actuator_force[self._actuator]))
            normals, friction = self._contacts_with(thing)
            self._grip = make_grip(self._palm_axes, normals, friction, force)
        else:
            self._grip = Grip(np.array(grip.pressing), grip.force_n, grip.bears_n)
        row, turn = self._model.eq_data[equality], quaternion_from_rotation(in_palm.rotation)
        row[:3], row[3:6], row[6:10], row[10] = 0.0, in_palm.position, turn, 1.0
        self._data.eq_active[equality] = 1

    def _let_go(self, thing: str) -> None:
        """Remove the weld."""
        self._data.eq_active[self._weld(thing)], self._grip = 0, None
        self._physics.release(thing)

    def _centre_error(self, thing: str) -> Array:
        """Return how far its centre of mass (3,) is from where it is known to be, in m, in the frame of the object."""
        sizes = self._physics.variation.imperfections.get(thing, NO_SIZES)
        return np.array(sizes.get("centreError", (0.0, 0.0, 0.0)))

    def _weld(self, thing: str) -> int:
        """Return the number of the weld that holds a thing."""
        return int(self._model.equality(weld_name(self._name, self._names[thing])).id)

    def _pull_of_weld(self) -> Array:
        """Return the force (3,) in N of the weld; 0 before it acts."""
        owners = self._data.efc_id[: self._data.ne].tolist()  # the rows of equality constraints come before all others
        weld = self._weld(self._carried)
        first = owners.index(weld) if weld in owners else None
        return np.zeros(3) if first is None else -self._data.efc_force[first : first + 3]

    def _save_grip(self) -> SavedGrip | None:
        """Return how friction holds what is carried."""
        if self._grip is None:
            return None
        x, y, z = self._grip.pressing.tolist()
        return SavedGrip((x, y, z), self._grip.force_n, self._grip.bears_n)

    def _restore_fingers(self, opening_m: float, force_n: float) -> None:
        """Let the fingers rest at an opening in m, with at most a force in N."""
        self._limit(force_n)
        self._goal = self._target = self._data.ctrl[self._actuator] = opening_m

    def _is_at_force_limit(self) -> bool:
        """Return whether the servo pushes with its greatest force, or pushed so when it grasped what the weld holds."""
        force_n = abs(float(self._data.actuator_force[self._actuator])) if self._grip is None else self._grip.force_n
        return force_n > 0.95 * self._limit_n
