"""What two models of an arm are compared by: link poses, flange Jacobian, mass matrix and weight in a posture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array, Pose

GRAVITY = (1.0, 2.0, -9.81)
"""Gravity in the comparison, m/s^2 along the axes of the base: every joint feels weight."""


@dataclass(frozen=True, slots=True, eq=False)
class Kinetics:
    """An arm in a posture, in the frame of its base.

    poses (n + 1, 3, 4): rotation and position in m of each link and of the flange; jacobian (6, n): of the flange,
    [linear m; angular rad]; mass_matrix (n, n) kg m^2; weight (n,) N m.
    """

    poses: Array
    jacobian: Array
    mass_matrix: Array
    weight: Array


class Mechanism(Protocol):
    """A model of an arm in one of the libraries."""

    def at(self, q: Array) -> Kinetics:
        """Return the arm with its joints at q (n,) in rad, or m for joints that slide."""
        ...


class PinocchioMechanism:
    """An arm in pinocchio, whose links are its joints; `flange` is in the last link's frame."""

    def __init__(self, model: Any, flange: Pose) -> None:
        import pinocchio

        self._pin, self._model, self._data = pinocchio, model, model.createData()
        model.gravity.linear = np.array(GRAVITY)
        self._flange = pinocchio.SE3(flange.rotation, flange.position)

    def at(self, q: Array) -> Kinetics:
        """Return the arm with its joints at q (n,) in rad, or m for joints that slide."""
        pin, model, data = self._pin, self._model, self._data
        full = pin.integrate(model, pin.neutral(model), q)
        pin.computeJointJacobians(model, data, full)
        last = model.njoints - 1
        flange = data.oMi[last] * self._flange
        J = pin.getJointJacobian(model, data, last, pin.LOCAL_WORLD_ALIGNED)
        arm = flange.translation - data.oMi[last].translation
        J = np.vstack([J[:3] + np.cross(J[3:], arm, axis=0), J[3:]])
        mass = np.triu(pin.crba(model, data, full))
        weight = pin.computeGeneralizedGravity(model, data, full).copy()
        poses = np.array([each.homogeneous[:3] for each in (*list(data.oMi)[1:], flange)])
        return Kinetics(poses, J, mass + np.triu(mass, 1).T, weight)


class MujocoMechanism:
    """An arm in MuJoCo; `links` are the bodies that its joints move, `flange` is in the frame of the last one.

    The base is at `base` in the world. A joint may be anywhere in its body: a link's frame is at its joint.
    """

    def __init__(self, model: Any, joints: Sequence[int], flange: Pose, base: Pose) -> None:
        model.opt.gravity[:] = base.rotation @ np.array(GRAVITY)
        self._model, self._data = model, mujoco.MjData(model)
        self._joints, self._flange, self._base = list(joints), flange, base
        self._bodies = [int(model.jnt_bodyid[joint]) for joint in joints]
        self._anchors = [model.jnt_pos[joint].copy() for joint in joints]
        self._qpos = [int(model.jnt_qposadr[joint]) for joint in joints]
        self._dofs = [int(model.jnt_dofadr[joint]) for joint in joints]

    def at(self, q: Array) -> Kinetics:
        """Return the arm with its joints at q (n,) in rad, or m for joints that slide."""
        model, data, home = self._model, self._data, self._base.inverse()
        data.qpos[:] = model.qpos0
        data.qpos[self._qpos] += q
        mujoco.mj_forward(model, data)
        links = [home @ self._link(body, anchor) for body, anchor in zip(self._bodies, self._anchors, strict=True)]
        flange = links[-1] @ self._flange
        J, full = np.zeros((6, model.nv)), np.zeros((model.nv, model.nv))
        mujoco.mj_jac(model, data, J[:3], J[3:], self._base.apply(flange.position), self._bodies[-1])
        mujoco.mj_fullM(model, data, full)
        turned = np.vstack([home.rotation @ J[:3, self._dofs], home.rotation @ J[3:, self._dofs]])
        poses = np.array([np.column_stack([each.rotation, each.position]) for each in (*links, flange)])
        return Kinetics(poses, turned, full[np.ix_(self._dofs, self._dofs)], data.qfrc_bias[self._dofs].copy())

    def _link(self, body: int, anchor: Array) -> Pose:
        here = Pose(self._data.xpos[body].copy(), self._data.xmat[body].reshape(3, 3).copy())
        return here @ Pose(anchor, np.eye(3))
