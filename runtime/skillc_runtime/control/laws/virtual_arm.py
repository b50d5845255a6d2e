"""A model of one arm without motors and weight: its kinematics, and virtual masses for forward-dynamics compliance.

The virtual model of forward-dynamics compliance (Scherzinger 2017): 1 kg and 1 kg m^2 at the tool centre point, a
hundredth of it at every link's origin, no gravity; so the response of the tool to a wrench is nearly isotropic. With
links of a tenth, as published, an acceleration in the plane causes a force along the normal: 4.7 % rms at the frequency
of a circle of 15 mm, compared with 1.4 %. Without Coriolis forces the mean force is 1 % too low.
"""

from __future__ import annotations

from copy import deepcopy
from pathlib import Path

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.control.laws.virtual_chain import make_chain, place_body
from skillc_runtime.kinematics.chain import Chain, read_chain
from skillc_runtime.motion.arrays import Matrix, OutMatrix, Vector
from skillc_runtime.motion.pose import Array, Pose, quaternion_from_rotation

LINK_MASS_KG, LINK_INERTIA = 0.01, 1e-6
TOOL_MASS_KG, TOOL_INERTIA = 1.0, 1.0
ROUNDING_M = 1e-9
"""How much longer than its links an arm that is stretched out may seem, in m."""


def load_virtual_model(path: Path) -> mujoco.MjModel:
    """Load an arm's MJCF, which has a site `flange`, with virtual masses; its root is the arm's base frame."""
    spec = mujoco.MjSpec.from_file(str(path))
    for part in (*spec.geoms, *spec.actuators, *spec.sensors, *spec.keys):
        spec.delete(part)
    for joint in spec.joints:
        joint.armature = 0.0
    for body in spec.bodies:
        if body.name != "world":
            _concentrate(body, LINK_MASS_KG, LINK_INERTIA)
    spec.option.gravity = [0.0, 0.0, 0.0]
    flange = spec.site("flange")
    tool = flange.parent.add_body(name="tool", pos=flange.pos, quat=flange.quat)
    _concentrate(tool, TOOL_MASS_KG, TOOL_INERTIA)
    return spec.compile()


def _concentrate(body: mujoco.MjsBody, mass: float, inertia: float) -> None:
    body.explicitinertial = True
    body.mass, body.inertia = mass, np.full(3, inertia)
    body.fullinertia = np.full(6, np.nan)
    body.ipos, body.iquat = np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0])


class VirtualState(msgspec.Struct, frozen=True):
    """Pose and dynamics of a virtual arm, in the arm's base frame; the arrays change with the arm.

    tool: the tool centre point; jacobian (6, nv): [linear m; angular rad] per rad; inertia (nv, nv): kg m^2, may be
    overwritten; bias (nv,): N m, Coriolis and centrifugal.
    """

    tool: Pose
    jacobian: Matrix
    inertia: OutMatrix
    bias: Vector


class VirtualArm:
    """Kinematics and virtual inertia at joint positions q, in the arm's base frame. Arrays are reused.

    `state` has all results; `chain` has the arm as numbers, for laws that compute the same. `virtual` is from
    `load_virtual_model`; it is copied, since the tool's pose in it changes.
    """

    def __init__(self, virtual: mujoco.MjModel) -> None:
        self._model = model = deepcopy(virtual)
        self._data = mujoco.MjData(self._model)
        self._body = model.body("tool").id
        self._flange = Pose.of(model.body_pos[self._body], model.body_quat[self._body])
        self._turn_of_flange = quaternion_from_rotation(self._flange.rotation)
        self._qpos = self._data.qpos
        self._position, self._rotation = self._data.xpos[self._body], self._data.xmat[self._body].reshape(3, 3)
        self.joints = model.nv
        self.turning: NDArray[np.bool_] = model.jnt_type == mujoco.mjtJoint.mjJNT_HINGE
        self.jacobian = np.zeros((6, model.nv))
        self._jacp, self._jacr = self.jacobian[:3], self.jacobian[3:]
        self.inertia = np.zeros((model.nv, model.nv))
        self.bias = np.zeros(model.nv)
        self.chain = make_chain(model, self._body)
        self.state = VirtualState(Pose(self._position, self._rotation), self.jacobian, self.inertia, self.bias)

    @property
    def tool(self) -> Pose:
        """The tool centre point in base; a copy."""
        return Pose(self._position.copy(), self._rotation.copy())

    def read_chain(self) -> Chain:
        """Return its joints as numbers, with the tool as it is mounted now."""
        return read_chain(self._model, "tool")

    def may_reach(self, target: Pose) -> bool:
        """Return False if the tool cannot be at `target` in base, since the links are too short for the hand there.

        Otherwise there may be a posture or not.
        """
        mount = Pose.of(self._model.body_pos[self._body], self._model.body_quat[self._body])
        hand = target @ mount.inverse()
        longest = self._measure_links(int(self._model.body_parentid[self._body]))
        return float(np.linalg.norm(hand.position)) <= longest + ROUNDING_M

    def _measure_links(self, body: int) -> float:
        """Return the distance in m between the base and the origin of a body that no posture exceeds."""
        model = self._model
        if body == 0:
            return 0.0
        longest = float(np.linalg.norm(model.body_pos[body]))
        for joint in range(model.body_jntadr[body], model.body_jntadr[body] + model.body_jntnum[body]):
            if self.turning[joint]:
                longest += 2.0 * float(np.linalg.norm(model.jnt_pos[joint]))
            else:
                longest += float(np.abs(model.jnt_range[joint]).max()) if model.jnt_limited[joint] else np.inf
        return longest + self._measure_links(int(model.body_parentid[body]))

    def joint_name(self, index: int) -> str:
        """Return the name of a joint, counted from 0, in the arm's model, or its number from 1 if it has none."""
        name = self._model.joint(index).name
        return f"the joint {name}" if name else f"joint {index + 1}"

    def joint_unit(self, index: int) -> str:
        """Return the unit of a joint, counted from 0: rad, or m if it slides."""
        return "rad" if self.turning[index] else "m"

    def mount_tool(self, q: Array, tool: Pose) -> None:
        """Place the tool centre point on the hand so that it is at `tool` in base for joints q (nv,) in rad.

        Move there.
        """
        self.hang_tool(q, tool)
        self.update_kinematics(q)

    def hang_tool(self, q: Array, tool: Pose) -> None:
        """Place the tool centre point on the hand so that it is at `tool` in base for joints q (nv,) in rad.

        For whoever moves on next: `tool` and `jacobian` are not updated.
        """
        position, quaternion = self._model.body_pos[self._body], self._model.body_quat[self._body]
        position[:], quaternion[:], self._qpos[:] = self._flange.position, self._turn_of_flange, q
        mujoco.mj_kinematics(self._model, self._data)
        mount = self._flange @ self.tool.inverse() @ tool
        position[:], quaternion[:] = mount.position, quaternion_from_rotation(mount.rotation)
        place_body(self.chain, self._body, mount.position, quaternion)

    def update_kinematics(self, q: Array) -> None:
        """Update `tool` and `jacobian` (6, nv) for joint positions q (nv,) in rad."""
        self._qpos[:] = q
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)
        mujoco.mj_jacBody(self._model, self._data, self._jacp, self._jacr, self._body)

    def update_dynamics(self, dq: Array) -> None:
        """Update `inertia` (nv, nv) in kg m^2 and, for dq (nv,) in rad/s, the Coriolis forces `bias` (nv,) in N m."""
        self._data.qvel[:] = dq
        mujoco.mj_comVel(self._model, self._data)
        mujoco.mj_rne(self._model, self._data, 0, self.bias)
        mujoco.mj_crb(self._model, self._data)
        mujoco.mj_fullM(self._model, self._data, self.inertia)
