"""Switches an arm between tool and joint control without a jump of the reference; in base axes."""

from __future__ import annotations

from math import dist

import numpy as np

from skillc_runtime.control.kinematics import JOINT_RAMP_S, Kinematics
from skillc_runtime.control.laws.controllers import make_controllers
from skillc_runtime.control.measured import MeasuredArm
from skillc_runtime.control.period import TASK, TOOL_JUMP_M_S
from skillc_runtime.control.setup import ArmSetup
from skillc_runtime.control.taring import Taring
from skillc_runtime.control.tool_task import ToolTask
from skillc_runtime.devices.arm import ArmState, Command
from skillc_runtime.motion.joint_reference_generator import JointReferenceGenerator
from skillc_runtime.motion.pose import Array, Pose


class ArmTask:
    """What one arm is doing: `joints` generates their reference, or is None while `tool` is controlled.

    All motions have the share `speed`, above 0 to 1, of theirs. place (3,): of the tool in the last period, m, in base;
    clock (4,): see `period`. `MotionControl` and
    `ComplianceControl` change it for skills; the driver asks it for a command once a control period.
    """

    def __init__(self, setup: ArmSetup) -> None:
        """Hold the joints at their positions."""
        state = setup.arm.state()
        self.limits, self.period, self.speed, self.clock = setup.limits, setup.period, 1.0, np.zeros(4)
        self.arm, self.place = setup.arm, state.tool.position.copy()
        self.taring = Taring(setup.arm, setup.safety.force_drift_n_s)
        self.measured = MeasuredArm(setup.base, self.contact_wrench, state)
        self.controllers = make_controllers(
            setup.gains, setup.limits, setup.virtual, state, setup.period, setup.arm.capabilities.command_delay_s
        )
        self.kinematics, self.workspace = Kinematics(setup.virtual), setup.safety.workspace
        self.tool = ToolTask(setup.gains, self.controllers.tool, state.tool)
        self.joints: JointReferenceGenerator | None = self._joint_reference(state.q, np.zeros_like(state.q))

    @property
    def now(self) -> float:
        """The time of motions in s, which stops while the arm is not controlled."""
        return float(self.clock[TASK])

    def contact_wrench(self) -> Array:
        """Return the wrench (6,) of the environment on the tool, N and N m, base axes."""
        return self.measured.state.wrench if self.joints is not None else self.tool.contact_wrench

    def command(self, state: ArmState) -> Command:
        """Return the command of the tool's law for the next control period; ControlError if it cannot continue."""
        self.tool.compliance.step(self.period)
        return self.tool.command(state, self.now, self.period)

    def update_state(self, state: ArmState) -> None:
        """Store a measured state; restart tool control if the tool centre point was moved on the hand."""
        jump = dist(state.tool.position, self.place)
        self.place[:], self.measured.state = state.tool.position, state
        if jump > TOOL_JUMP_M_S * self.period:
            self.restart_tool(state)

    def restart_tool(self, state: ArmState) -> None:
        """Hold the tool where it is, if it is controlled, after it was moved on the hand."""
        if self.joints is None:
            self.tool.restart_here(state, self.controllers.joints_now(state), self.now)

    def move_tool(self) -> ToolTask:
        """Switch from joint to tool control; the tool continues as the joints moved it."""
        self.update_state(self.arm.state())
        if self.joints is not None:
            self.taring.tare_first(self.measured.state.dq)
            state, reference = self.measured.state, self.joints.sample(self.now)
            tool, jacobian = self.kinematics.tool_at(reference.q, state)
            self.tool.restart_from(state, reference, tool, jacobian @ reference.dq, self.now)
            self.joints = None
        return self.tool

    def move_joints(self) -> JointReferenceGenerator:
        """Switch from tool to joint control; the joints continue as the tool moved them."""
        if self.joints is None:
            self.joints = self.stopping_joint_reference()
        return self.joints

    def stopping_joint_reference(self) -> JointReferenceGenerator:
        """Return a reference that comes to rest from the present motion of the joints; nothing changes."""
        state = self.measured.state
        return self._joint_reference(self.controllers.joints_now(state), self.controllers.speeds_now(state))

    def set_speed(self, speed: float) -> None:
        """Let all motions, also the present one, have a share of their speed, above 0 to 1; forces stay as they are."""
        self.speed = speed
        self.tool.reference_generator.set_speed(speed, self.now)
        if self.joints is not None:
            self.joints.set_speed(speed, self.now)

    def stop(self) -> None:
        """Come to rest within the acceleration limit; compliance, push and overlays are kept."""
        (self.joints or self.tool.reference_generator).stop(self.now)

    def hold_still(self) -> None:
        """Hold the arm at its present position, at once, and stop pushing."""
        q = self.controllers.joints_held(self.measured.state)
        if self.joints is None:
            self.tool.hold(self.measured.state, q, self.now)
        else:
            self.joints = self._joint_reference(q, np.zeros_like(q))

    def hold_joints(self, state: ArmState) -> None:
        """Hold the joints from now on, after a control law has failed."""
        self.joints = self._joint_reference(self.controllers.joints_now(state), np.zeros_like(state.q))

    def base(self) -> Pose:
        """Return the pose of the arm's base in the world."""
        return self.measured.base()

    def _joint_reference(self, q: Array, dq: Array) -> JointReferenceGenerator:
        return JointReferenceGenerator(q, dq, float(self.limits.velocity.min()) / JOINT_RAMP_S, self.now, self.speed)
