"""Proves that a model that was written is the arm of the file: both are compared in random postures."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple, TypeAlias
from xml.etree import ElementTree

import mujoco
import numpy as np

from skillc.errors import RequestError
from skillc.services.robot_import.robot_model import RobotModel
from skillc_runtime.motion.pose import Array, Pose

POSTURES, SEED = 200, 1
TOLERANCE = 1e-8
"""Largest difference of models that agree: of poses and Jacobians in m and rad, else relative to the largest entry."""

GRAVITY = (1.0, 2.0, -9.81)
"""Gravity in the comparison, m/s^2 along the axes of the base: every joint feels weight."""


class Kinetics(NamedTuple):
    """An arm in a posture, in the frame of its base, or by how much two differ.

    poses (n + 1, 3, 4): rotation and position in m of each link and of the flange; jacobians (6, n): of the flange,
    [linear m; angular rad]; mass_matrices (n, n) kg m^2; weights (n,) N m.
    """

    poses: Any
    jacobians: Any
    mass_matrices: Any
    weights: Any

    def differ(self, other: Kinetics) -> Kinetics:
        """Return the largest differences, those of masses and weights as shares of the largest entry."""
        sizes = (1.0, 1.0, *(max(float(np.abs(each).max()), 1e-9) for each in self[2:]))
        pairs = zip(self, other, sizes, strict=True)
        return Kinetics(*(float(np.abs(one - another).max() / size) for one, another, size in pairs))

    @property
    def worst(self) -> str:
        """What differs most."""
        return ("poses", "Jacobians", "mass matrices", "weights")[int(np.argmax(self))]


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
        pin.computeJointJacobians(model, data, q)
        last = model.njoints - 1
        flange = data.oMi[last] * self._flange
        J = pin.getJointJacobian(model, data, last, pin.LOCAL_WORLD_ALIGNED)
        arm = flange.translation - data.oMi[last].translation
        J = np.vstack([J[:3] + np.cross(J[3:], arm, axis=0), J[3:]])
        mass = np.triu(pin.crba(model, data, q))
        weight = pin.computeGeneralizedGravity(model, data, q).copy()
        poses = np.array([each.homogeneous[:3] for each in (*list(data.oMi)[1:], flange)])
        return Kinetics(poses, J, mass + np.triu(mass, 1).T, weight)


class MujocoMechanism:
    """An arm in MuJoCo, with the numbers of its joints; `flange` is in the frame of the last link.

    The base is at `base` in the world. A joint may be anywhere in its body: a link's frame is at its joint.
    """

    def __init__(self, model: Any, joints: Sequence[int], flange: Pose, base: Pose) -> None:
        model.opt.gravity[:] = base.rotation @ np.array(GRAVITY)
        self._model, self._data, self._joints = model, mujoco.MjData(model), list(joints)
        self._flange, self._home = flange, base.inverse()
        self._dofs = model.jnt_dofadr[self._joints]

    def at(self, q: Array) -> Kinetics:
        """Return the arm with its joints at q (n,) in rad, or m for joints that slide."""
        model, data, home = self._model, self._data, self._home
        data.qpos[:] = model.qpos0
        data.qpos[model.jnt_qposadr[self._joints]] += q
        mujoco.mj_forward(model, data)
        links = [self._link(joint) for joint in self._joints]
        flange = links[-1] @ self._flange
        J, full = np.zeros((6, model.nv)), np.zeros((model.nv, model.nv))
        mujoco.mj_jac(model, data, J[:3], J[3:], flange.position, model.jnt_bodyid[self._joints[-1]])
        mujoco.mj_fullM(model, data, full)
        turned = np.vstack([home.rotation @ J[:3, self._dofs], home.rotation @ J[3:, self._dofs]])
        here = [home @ each for each in (*links, flange)]
        poses = np.array([np.column_stack([each.rotation, each.position]) for each in here])
        return Kinetics(poses, turned, full[np.ix_(self._dofs, self._dofs)], data.qfrc_bias[self._dofs].copy())

    def _link(self, joint: int) -> Pose:
        body = self._model.jnt_bodyid[joint]
        here = Pose(self._data.xpos[body].copy(), self._data.xmat[body].reshape(3, 3).copy())
        return here @ Pose(self._model.jnt_pos[joint].copy(), np.eye(3))


Mechanism: TypeAlias = MujocoMechanism | PinocchioMechanism
"""A model of an arm in one of the libraries."""


def prove_same(model: RobotModel, source: Mechanism, mjcf: Path) -> Kinetics:
    """Return how little an MJCF file, read by pinocchio, differs from a model and from what MuJoCo read.

    RequestError if it differs more than by rounding.
    """
    import pinocchio

    root = ElementTree.fromstring(mjcf.read_bytes())
    for number, element in enumerate((*root.iter("body"), *root.iter("joint"))):
        element.set("name", f"{element.tag}{number}")  # Some names are pinocchio's own: it ends the process.
    for motors in root.findall("actuator"):
        root.remove(motors)
    with TemporaryDirectory() as folder:
        renamed = Path(folder, mjcf.name)
        ElementTree.ElementTree(root).write(renamed, "utf-8")
        written = pinocchio.buildModelFromMJCF(str(renamed))
    found = compare(model, source, PinocchioMechanism(written, model.flange))
    if not all(each <= TOLERANCE for each in found):  # Numbers of the file may be NaN.
        raise RequestError(
            f"the model that was made differs from the file: {found.worst} by {max(found):.1e}, and {TOLERANCE:g} "
            "is allowed; nothing was written"
        )
    return found


def compare(model: RobotModel, one: Mechanism, other: Mechanism) -> Kinetics:
    """Return how much two mechanisms with the joints of a model differ in `POSTURES` postures within its limits."""
    low = np.array([link.joint.low for link in model.links])
    high = np.array([link.joint.high for link in model.links])
    postures = np.random.default_rng(SEED).uniform(low, high, (POSTURES, low.size))
    return Kinetics(*np.max([one.at(q).differ(other.at(q)) for q in postures], axis=0).tolist())
