"""A test bench: one arm with a padded tool over a plate, simulated as plainly as possible, and its gains."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import mujoco
import numpy as np

import skillc_ontology
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.control.gains import read_gains
from skillc_runtime.control.laws.virtual_arm import load_virtual_model
from skillc_runtime.control.setup import ArmSetup
from skillc_runtime.devices.arm import ArmLimits, ArmState, Capabilities, JointPosition, Torque
from skillc_runtime.motion.pose import Pose, exp, quaternion_from_rotation, skew

ROBOTS = Path(skillc_ontology.__file__).parent / "robots"
COMMON = {"dampingRatio": 1.0, "commandTime": 0.1, "forceLimit": 50.0, "speedLimit": 0.5, "accelerationLimit": 0.5}
SHEETS = {
    "iiwa14": {
        **COMMON,
        "linearStiffness": 1500.0,
        "rotationalStiffness": 200.0,
        "dampingFloor": 60.0,
        "rotationalDampingFloor": 3.0,
        "nullspaceStiffness": 10.0,
        "torqueRate": 1000.0,
    },
    "ur5e": {
        **COMMON,
        "linearStiffness": 1000.0,
        "rotationalStiffness": 50.0,
        "admittance": 0.018,
        "rotationalAdmittance": 1.0,
        "admittanceTime": 0.02,
    },
}
SERVO_KP, SERVO_KV = 10000.0, 200.0
LAWS = {"iiwa14": "impedance", "ur5e": "forward_dynamics"}
HOMES = {"iiwa14": [0.0, 0.5, 0.0, -1.6, 0.0, 1.04, 0.0], "ur5e": [0.0, -1.9, 2.2, -1.87, -1.5708, 0.0]}
GAINS = {robot: read_gains(LAWS[robot], sheet.__getitem__) for robot, sheet in SHEETS.items()}
TOOL_M = np.array([0.1, 0.05, 0.03])
_load_virtual = cache(load_virtual_model)


def moved_by(pose: Pose, *way: float, turn=(0.0, 0.0, 0.0)) -> Pose:
    """The pose moved by a way in m and turned by a rotation vector."""
    return Pose(pose.position + np.array(way), exp(np.array(turn)) @ pose.rotation)


class Bench:
    """Implements `Arm`, to be read between `mj_step1` and `mj_step2`.

    The plate lies `gap` m below the tool, tilted by the rotation vector `tilt`; None for no plate.
    """

    mean_wrench = None

    def __init__(
        self, robot: str, gap: float | None = None, tilt=(0.0, 0.0, 0.0), friction=0.5, period=0.001, base=None
    ) -> None:
        self.robot, self.period = robot, period
        self.base = base or Pose.of((0, 0, 0))
        self.model = _model(robot, gap, tilt, friction, self.base)
        self.data = mujoco.MjData(self.model)
        self.interface = "torque" if LAWS[robot] == "impedance" else "position"
        self.nv = len(HOMES[robot])
        self.data.qpos[: self.nv] = HOMES[robot]
        if self.interface == "position":
            self.data.ctrl[:] = HOMES[robot]
        self._tip, self._flange = self.model.site("tip").id, self.model.site("flange").id
        self._pad, self._eraser = self.model.geom("pad").id, self.model.body("eraser").id
        self._jacobian = np.zeros((6, self.model.nv))
        mujoco.mj_forward(self.model, self.data)
        ranges = self.model.jnt_range.copy()
        control = self.model.actuator_ctrlrange if self.interface == "torque" else self.model.actuator_forcerange
        self.limits = ArmLimits(ranges, np.full(self.nv, 2.0), control[:, 1].copy(), np.full(self.nv, np.inf))
        virtual = _load_virtual(ROBOTS / f"{robot}.xml")
        self.driver = CompliantArmDriver(ArmSetup(self, virtual, GAINS[robot], self.limits, lambda: self.base, period))
        self.log: dict[str, list] = {"time": [], "force": [], "tool": [], "torque": []}

    @property
    def capabilities(self) -> Capabilities:
        return Capabilities((self.interface,), self.interface == "position", False, self.limits)

    def state(self) -> ArmState:
        m, d = self.model, self.data
        R = self.base.rotation
        J = self._jacobian
        mujoco.mj_jacSite(m, d, J[:3], J[3:], self._tip)
        M = np.zeros((m.nv, m.nv))
        mujoco.mj_fullM(m, d, M)
        tip = Pose(d.site_xpos[self._tip].copy(), d.site_xmat[self._tip].reshape(3, 3).copy())
        wrench = self._wrist(tip.position) if self.interface == "position" else np.zeros(6)
        in_base = (J.reshape(2, 3, -1).transpose(0, 2, 1) @ R).transpose(0, 2, 1).reshape(6, -1)
        return ArmState(
            d.qpos.copy(),
            d.qvel.copy(),
            self.base.inverse() @ tip,
            in_base,
            M,
            d.qfrc_bias.copy(),
            (wrench.reshape(2, 3) @ R).ravel(),
            np.zeros(m.nv),
        )

    def state_at_rest(self) -> ArmState:
        """The state after joint positions were set by hand."""
        mujoco.mj_forward(self.model, self.data)
        return self.state()

    def contact(self) -> np.ndarray:
        """The force of the plate on the tool, in the world, as the solver has it."""
        total, local = np.zeros(3), np.zeros(6)
        for i in range(self.data.ncon):
            mujoco.mj_contactForce(self.model, self.data, i, local)
            sign = 1 if self.data.contact.geom2[i] == self._pad else -1
            total += sign * (local[:3] @ self.data.contact.frame[i].reshape(3, 3))
        return total

    def _wrist(self, point) -> np.ndarray:
        """What the wrist sensor feels, at a point, its tool's weight removed; in the world."""
        axes = self.data.site_xmat[self._flange].reshape(3, 3)
        force, torque = self.data.sensordata.reshape(2, 3) @ axes.T
        weight = self.model.body_mass[self._eraser] * self.model.opt.gravity
        origin, mass_at = self.data.site_xpos[self._flange], self.data.xipos[self._eraser]
        force, torque = -weight - force, -skew(mass_at - origin) @ weight - torque
        return np.concatenate([force, torque - skew(point - origin) @ force])

    def command(self, command) -> None:
        match command:
            case Torque(tau=tau):
                assert self.interface == "torque"
                self.data.ctrl[:] = tau
            case JointPosition(q=q):
                assert self.interface == "position"
                self.data.ctrl[:] = q

    def run(self, seconds: float, each=None) -> None:
        """Step the arm at the control period and the world at 1 ms."""
        for _ in range(round(seconds / self.period)):
            mujoco.mj_step1(self.model, self.data)
            self.driver.step(self.data.time)
            self._physics()
            for _ in range(round(self.period / 0.001) - 1):
                mujoco.mj_step1(self.model, self.data)
                self._physics()
            self.log["time"].append(self.data.time)
            self.log["force"].append(self.contact())
            self.log["tool"].append(self.driver.measured.pose.position)
            self.log["torque"].append(self.data.ctrl.copy())
            if each:
                each()

    def until_done(self, limit: float = 30.0) -> None:
        end = self.data.time + limit
        self.run(self.period)
        while not self.driver.motion.done:
            assert self.data.time < end, "the motion does not end"
            self.run(0.01)

    def _physics(self) -> None:
        if self.interface == "position":
            self.data.qfrc_applied[:] = self.data.qfrc_bias
        mujoco.mj_step2(self.model, self.data)


def _model(robot: str, gap, tilt, friction, base: Pose) -> mujoco.MjModel:
    spec = mujoco.MjSpec.from_file(str(ROBOTS / f"{robot}.xml"))
    spec.option.timestep, spec.option.cone = 0.001, mujoco.mjtCone.mjCONE_ELLIPTIC
    root = spec.worldbody.first_body()
    root.pos, root.quat = base.position, quaternion_from_rotation(base.rotation)
    if LAWS[robot] == "forward_dynamics":
        _give_servos(spec)
    flange = spec.site("flange")
    tool = flange.parent.add_body(name="eraser", pos=flange.pos, quat=flange.quat)
    tool.add_geom(
        name="pad", type=mujoco.mjtGeom.mjGEOM_BOX, size=TOOL_M / 2, pos=[0, 0, TOOL_M[2] / 2 + 0.1], mass=0.2
    )
    tool.add_site(name="tip", pos=[0, 0, TOOL_M[2] + 0.1])
    wrist = tool.add_site(name="wrist")
    for kind in (mujoco.mjtSensor.mjSENS_FORCE, mujoco.mjtSensor.mjSENS_TORQUE):
        spec.add_sensor(type=kind, objtype=mujoco.mjtObj.mjOBJ_SITE, objname=wrist.name)
    pad = spec.geom("pad")
    pad.contype, pad.conaffinity, pad.priority = 2, 1, 1
    pad.solref, pad.solimp, pad.friction = [0.08, 1], [0.05, 0.9, 0.02, 0.5, 2], [friction, 0.005, 0.0001]
    if gap is not None:
        bare = spec.compile()
        data = mujoco.MjData(bare)
        data.qpos[:] = HOMES[robot]
        mujoco.mj_forward(bare, data)
        tip, R = data.site("tip").xpos, data.site("tip").xmat.reshape(3, 3)
        turn = np.zeros(4)
        mujoco.mju_mat2Quat(turn, (R @ np.diag([1.0, -1.0, -1.0])).ravel())
        more = np.zeros(4)
        angle = float(np.linalg.norm(tilt))
        mujoco.mju_axisAngle2Quat(more, np.array(tilt) / angle if angle else np.array([0, 0, 1.0]), angle)
        quat = np.zeros(4)
        mujoco.mju_mulQuat(quat, turn, more)
        plate = spec.worldbody.add_body(name="plate", pos=tip + R[:, 2] * gap, quat=quat)
        face = plate.add_geom(name="plate", type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.4, 0.4, 0.02], pos=[0, 0, -0.02])
        face.contype, face.conaffinity = 1, 2
    return spec.compile()


def _give_servos(spec: mujoco.MjSpec) -> None:
    """Give a position-controlled arm servos that take a command every few steps without smoothing."""
    for actuator in spec.actuators:
        actuator.gainprm[0], actuator.biasprm[1], actuator.biasprm[2] = SERVO_KP, -SERVO_KP, -SERVO_KV
