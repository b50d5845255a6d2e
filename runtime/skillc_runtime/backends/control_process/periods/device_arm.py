"""An arm in the model of a cell whose joints are where a device measures them."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from msgspec.structs import replace

from skillc_runtime.backends.control_process.fingers import find_fingers
from skillc_runtime.backends.control_process.link import LinkAbilities, PointMass, StateView
from skillc_runtime.backends.control_process.periods.command_slot import CommandSlot
from skillc_runtime.backends.simulation.arms.arm import ModelledArm, Payload
from skillc_runtime.backends.simulation.arms.motors import Joints, Motors
from skillc_runtime.backends.simulation.model.model_builder import build_model
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.backends.simulation.variation.variation import exact_variation
from skillc_runtime.devices.arm import Capabilities
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.state.data_sheet import SheetError


def build_arm(facts: ArmSpec, names: dict[str, str], abilities: LinkAbilities, period_s: float) -> DeviceArm:
    """Return the arm with its gripper, alone in a model; SheetError if the facts do not fit each other or the device.

    `names` are the short names of individuals.
    """
    scene = SceneSpec(names, (replace(facts, robot=None),), (), (), (), (), {})
    model = build_model(scene, exact_variation(scene), period_s)
    return DeviceArm(facts, names, abilities, model, mujoco.MjData(model))


class DeviceArm(ModelledArm):
    """One arm of a control process; implements `Arm` with what a device measures. `slot` has its command."""

    slot: CommandSlot

    def __init__(self, facts: ArmSpec, names: dict[str, str], abilities: LinkAbilities, model: Any, data: Any) -> None:
        """Place the joints at home until something is measured."""
        self._abilities, self._to_tool, self._moment = abilities, np.zeros((3, 3)), np.zeros((3, 3))
        self.hand, self._mass_kg = PointMass(0.0, np.zeros(3)), 0.0
        super().__init__(facts, names, model, data, facts.home, 1)
        if facts.force_torque and abilities.wrench == "none":
            raise SheetError(
                f"{names[facts.individual]} has a force-torque sensor in the scene; its device measures no wrench"
            )
        self._feels_force = facts.force_torque
        self._gain[:, :6] = np.eye(6)
        self._gravity = np.zeros(model.nv)
        self._fingers, self._shares = np.zeros(0, dtype=int), np.ones(1)
        if facts.gripper is not None:
            self._fingers, self._shares = find_fingers(model, names[facts.gripper.individual])
        self.set_fingers(0.0 if facts.gripper is None else facts.gripper.first_opening_m)

    @property
    def capabilities(self) -> Capabilities:
        """The capabilities of the arm."""
        return Capabilities(self._motors.modes, self._feels_force, self._abilities.measures_effort, self.limits)

    @property
    def held(self) -> PointMass:
        """The load of the hand, in the frame of the flange."""
        return PointMass(self.payload.mass_kg, self._flange.inverse().apply(self.payload.centre))

    @property
    def tool_on_flange(self) -> Pose:
        """The tool centre point on the flange."""
        return self._flange.inverse() @ self._tool

    @property
    def weight_torques(self) -> Array:
        """The torques (nv,) in N m that carry arm, hand and load in the measured posture, at rest."""
        torques: Array = self._gravity[self._dofs] + self._carrying
        return torques

    def set_fingers(self, opening_m: float) -> None:
        """Let the fingers be so far open: where they are shifts the weight of the hand."""
        self._data.qpos[self._fingers] = opening_m / self._shares.sum()
        self._place()
        self.hand = self._find_hand(self._gripper_name)
        self._update_weight()

    def measure(self, measured: StateView, now: float) -> None:
        """Put the joints where they were measured, at `now` s."""
        data = self._data
        data.time = now
        self._q[:], self._dq[:] = measured.q, measured.dq
        data.qfrc_actuator[self._dofs] = measured.effort
        self._place()
        if self._feels_force:
            self._feel(measured.wrench)

    def _place(self) -> None:
        """Compute what follows from positions and speeds of the joints."""
        model, data = self._model, self._data
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        if self._abilities.carries_weight:
            moving = data.qvel.copy()
            data.qvel[:] = 0.0
            mujoco.mj_comVel(model, data)
            mujoco.mj_rne(model, data, 0, self._gravity)
            data.qvel[:] = moving
        mujoco.mj_comVel(model, data)
        mujoco.mj_rne(model, data, 0, data.qfrc_bias)

    def _feel(self, wrench: Array) -> None:
        """Take a wrench (6,) at the flange, N and N m along its axes, and move it to the tool centre point."""
        force, moment = wrench[:3], wrench[3:]
        if self._abilities.wrench != "without-weight":
            down = (self._sensing.link.rotation @ self._flange.rotation).T @ self._model.opt.gravity
            force, moment = force - self._mass_kg * down, moment - self._moment @ down
        self._readings[:3], self._readings[3:6] = force, moment - self._to_tool @ force

    def _make_motors(self, facts: ArmSpec, actuators: slice, steps_per_command: int) -> Motors:
        data, here = self._data, self._here
        joints = Joints(
            data.ctrl[actuators], data.qfrc_applied[self._dofs], self._q, self._dq, self._bias,
            here.bias, self._carrying, here.mass_matrix, self.limits.effort,
        )  # fmt: skip
        self.has_own_law = "tool" in self._abilities.modes
        wanted_modes = ("position",) if self.has_own_law else facts.modes
        offered = tuple(mode for mode in wanted_modes if mode in self._abilities.modes)
        if not offered:
            taken, wanted = " and ".join(self._abilities.modes), " and ".join(facts.modes)
            raise SheetError(f"the arm takes {wanted} commands in the scene; its device takes {taken} commands")
        self.slot = CommandSlot(joints, offered, self._model.opt.timestep)
        return self.slot

    def _configure(self, payload: Payload, tool: Pose) -> None:
        super()._configure(payload, tool)
        self._to_tool = make_skew(self._lever())
        self._update_weight()

    def _update_weight(self) -> None:
        """Compute the mass that the wrench has, in kg, and its first moment (3, 3) in kg m, as a cross product."""
        felt = (self.hand, self.held) if self._abilities.wrench == "with-weight" else (self.held,)
        self._mass_kg = sum(each.mass_kg for each in felt)
        self._moment = sum((each.mass_kg * make_skew(each.centre) for each in felt), np.zeros((3, 3)))

    def _update_mass_matrix(self) -> None:
        mujoco.mj_crb(self._model, self._data)
        super()._update_mass_matrix()

    def _find_hand(self, gripper: str | None) -> PointMass:
        """Return the mass of the gripper, in the frame of the flange; 0 without one."""
        model, data = self._model, self._data
        prefix = None if gripper is None else part_name(gripper, "")
        bodies = [] if prefix is None else [b for b in range(model.nbody) if model.body(b).name.startswith(prefix)]
        masses = model.body_mass[bodies]
        if not masses.sum() > 0.0:
            return PointMass(0.0, np.zeros(3))
        link = self._sensing.link
        flange = Pose(link.position, link.rotation) @ self._flange
        centre = (masses @ data.xipos[bodies]) / masses.sum()
        return PointMass(float(masses.sum()), flange.inverse().apply(centre))


def make_skew(vector: Array) -> Array:
    """Return the matrix (3, 3) S of a vector (3,) with S w = vector x w."""
    x, y, z = vector.tolist()
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
