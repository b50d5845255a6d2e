"""Cargo of a mobile base that feels its acceleration: it slips, tips over and falls off as friction and mass let it.

The physics knows no velocity of a base: its position is set in each step, and what stands on it is moved with it, so
that the physics computes its motion relative to the base, under the forces of inertia there:

    F = -m dV/dt,  M = -I dw/dt

V is the velocity of the base at the centre of mass, w its angular velocity. Products of w with the angular velocity of
the thing relative to the base are left out: they are small for bases that turn with less than 1 rad/s.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from skillc_runtime.backends.simulation.bases.base import BaseStep
from skillc_runtime.backends.simulation.bases.base_drive import STEPS_PER_LOOK
from skillc_runtime.backends.simulation.cargo import Cargo
from skillc_runtime.backends.simulation.contacts import Contacts
from skillc_runtime.backends.simulation.hands.gripper import ModelledGripper
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.motion.pose import Array, Pose, log

AT_REST = BaseStep(Pose.of((0.0, 0.0, 0.0)), Pose.of((0.0, 0.0, 0.0)))


class InertialCargo(Cargo):
    """The cargo of one mobile base: what touches it, or other cargo, and nothing that does not drive with it.

    What leaves the base keeps its velocity in the world. What arms hold does not feel the acceleration.
    """

    def __init__(
        self, scene: SceneSpec, robot: str, hands: Mapping[str, ModelledGripper], model: Any, data: Any,
        contacts: Contacts,
    ) -> None:  # fmt: skip
        super().__init__(scene, robot, hands, model, data, contacts)
        self._period_s, self._driving = float(model.opt.timestep), False
        self._parts = {block: np.flatnonzero(model.body_rootid == block).tolist() for block in self._blocks.values()}
        self._members: list[int] = []
        self._velocities: dict[int, Array] = {}
        """The velocity (6,) of the base at each body of the cargo in the step before: m/s and rad/s, in the world."""

    @property
    def at_rest(self) -> bool:
        """Whether nothing is left to be done while the base is at rest."""
        return not self._driving and not self._members

    @property
    def is_empty(self) -> bool:
        return self._driving and not self._members and not self._hands_carry

    def move(self, step: BaseStep | None) -> None:
        """Move the cargo with the base; None while that is at rest."""
        if step is None and not self._driving:
            self._unload(list(self._members), AT_REST)
            return
        begins = not self._driving
        step, self._driving = step or AT_REST, step is not None
        if begins or step.number % STEPS_PER_LOOK == 0:
            self._update_members(step)
        for hand in self._own:
            hand.move_with_base(step)
        for block in self._members:
            self._carry(block, step.motion)
            self._push(block, step)

    def _push(self, block: int, step: BaseStep) -> None:
        """Apply the forces of inertia to all parts of a thing."""
        data, model = self._data, self._model
        for part in self._parts[block]:
            velocity = self._base_velocity(data.xipos[part], step)
            change = (velocity - self._velocities.get(part, velocity)) / self._period_s
            axes = data.ximat[part].reshape(3, 3)
            data.xfrc_applied[part, :3] = -model.body_mass[part] * change[:3]
            data.xfrc_applied[part, 3:] = -axes @ (model.body_inertia[part] * (axes.T @ change[3:]))
            self._velocities[part] = velocity

    def _update_members(self, step: BaseStep) -> None:
        """Load what stands on the base, and unload what touches something else instead."""
        free = set(self._free_blocks())
        neighbours, held_up = self._read_contacts()
        standing, found = {self._base}, {self._base}
        while found:
            found = {each for one in found for each in neighbours.get(one, ())} & free - held_up - standing
            standing |= found
        standing.remove(self._base)
        self._unload([each for each in self._members if each not in standing and each in held_up - free], step)
        for block in sorted(standing - set(self._members)):
            self._members.append(block)
            self._change_velocity(block, -self._base_velocity(self._data.xpos[block], step))

    def _read_contacts(self) -> tuple[dict[int, set[int]], set[int]]:
        """Return what touches each root body, of the base and of things, and the things that touch anything else."""
        roots = self._model.body_rootid[self._model.geom_bodyid[self._contacts.geoms]]
        own = {self._base, *self._blocks.values()}
        neighbours, held_up = dict[int, set[int]](), set[int]()
        for one, other in {*map(tuple, roots.tolist()), *map(tuple, roots[:, ::-1].tolist())}:
            if other in own:
                neighbours.setdefault(one, set()).add(other)
            else:
                held_up.add(one)
        return neighbours, held_up

    def _unload(self, blocks: list[int], step: BaseStep) -> None:
        """Let things go on with the velocity that they have in the world."""
        for block in blocks:
            self._members.remove(block)
            self._change_velocity(block, self._base_velocity(self._data.xpos[block], step))
            for part in self._parts[block]:
                self._data.xfrc_applied[part] = 0.0
                self._velocities.pop(part, None)

    def _change_velocity(self, block: int, change: Array) -> None:
        """Change the velocity of a thing by (6,) m/s and rad/s in the world."""
        first = self._model.jnt_dofadr[self._model.body_jntadr[block]]
        self._data.qvel[first : first + 3] += change[:3]
        self._data.qvel[first + 3 : first + 6] += self._data.xmat[block].reshape(3, 3).T @ change[3:]

    def _base_velocity(self, point: Array, step: BaseStep) -> Array:
        """Return the velocity (6,) of the base at a point (3,) in m: m/s and rad/s, in the world."""
        return np.concatenate([step.motion.apply(point) - point, log(step.motion.rotation)]) / self._period_s
