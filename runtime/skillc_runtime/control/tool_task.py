"""What the tool of an arm shall do, in the arm's base frame: where it shall be, how it yields and pushes."""

from __future__ import annotations

import numpy as np

from skillc_runtime.control.compliance_state import ComplianceState
from skillc_runtime.control.controller import Controller
from skillc_runtime.control.gains import Gains
from skillc_runtime.devices.arm import ArmState, Command
from skillc_runtime.motion.joint import JointReference
from skillc_runtime.motion.pose import Array, Pose, log
from skillc_runtime.motion.reference_generator import ReferenceGenerator

NEAR_M, NEAR_RAD = 0.005, 0.05
"""How far the tool may be from its reference to count as there; a pushing one may be behind by friction besides."""


class ToolTask:
    """`reference_generator` says where, `compliance` how; both change when something is released or restored.

    `reference` is that of the last control period, in base. Times are in s.
    """

    def __init__(self, gains: Gains, law: Controller, tool: Pose) -> None:
        self.reference_generator = ReferenceGenerator(tool, gains.limits.acceleration_m_s2)
        self.compliance = ComplianceState(gains)
        self._stiffness, self._force_limit = gains.linear_stiffness, gains.limits.force_n
        self._law = law
        self.reference = self.reference_generator.sample(0.0)

    def command(self, state: ArmState, now: float, period: float) -> Command:
        """Return what to command for the next `period` s; times in s."""
        self.reference = self.reference_generator.sample(now)
        return self._law.command(state, self.reference, self.compliance.applied, period)

    def restart_from(self, state: ArmState, joints: JointReference, tool: Pose, twist: Array, now: float) -> None:
        """Come to rest from joints where the tool is at `tool`, in base, and moves with a twist (6,), m/s and rad/s."""
        self._law.reset(state, joints.q, joints.dq)
        self.reference_generator.restart_from(tool, twist, now)
        self.reference = self.reference_generator.sample(now)

    def restart_here(self, state: ArmState, q: Array, now: float) -> None:
        """Hold the tool where it is, the joints at q (nv,) rad: its centre point was moved on the hand."""
        self._law.reset(state, q, np.zeros_like(q))
        self.reference_generator.restart_from(self._law.tool, np.zeros(6), now)

    def hold(self, state: ArmState, q: Array, now: float) -> None:
        """Hold the tool where it is, the joints at q (nv,) rad, at once: motions end, and it pushes no more."""
        self.reference_generator.drop_overlays()
        self.restart_here(state, q, now)
        self.compliance.push_off()

    def let_go(self, now: float) -> None:
        """Let push and overlays fade."""
        self.compliance.push_off()
        self.reference_generator.fade_overlays(now)

    @property
    def contact_wrench(self) -> Array:
        """What the environment does to the tool (6,), N and N m, base axes."""
        return self._law.contact_wrench

    def in_tool(self, direction: Array, now: float) -> Array:
        """Return a direction (3,) of the base frame in the reference tool frame."""
        return self.reference_generator.path_pose(now).rotation.T @ direction

    def restore(self, now: float) -> None:
        """Undo the last release: hold the tool, along what it has yielded, where it is. Gives up a motion."""
        reference, wanted = self.reference_generator.sample(now).pose, self.compliance.wanted
        away = self._law.tool.position - reference.position
        regained = reference.rotation @ self.compliance.regained_axes()
        self.compliance.restore((reference.rotation @ wanted.frame).T @ away)
        resting = self.reference_generator.path_pose(now)
        place = Pose(resting.position + regained @ (regained.T @ away), resting.rotation)
        self.reference_generator.jump_to(place, np.eye(3) - regained @ regained.T, now)

    def push(self, direction: Array, force_n: float, fastest_m_s: float, now: float) -> None:
        """Press along a direction (3,) in base; ValueError where the arm may not, or does not yield along it."""
        if not 0 <= force_n <= self._force_limit:
            raise ValueError(f"{force_n:g} N is beyond the {self._force_limit:g} N that the arm may push with")
        self.compliance.push(self.in_tool(direction, now), force_n, fastest_m_s)

    def restore_rotation(self, now: float) -> None:
        """Hold the tool in the rotation that it has. Gives up a motion."""
        self.compliance.set_rotation_free(False)
        resting = self.reference_generator.path_pose(now)
        self.reference_generator.jump_to(Pose(resting.position, self._law.tool.rotation), np.eye(3), now)

    def tracking_error_message(self, state: ArmState, now: float) -> str | None:
        """Return how far the tool is from its reference along what it is to hold; None when near enough."""
        reference, wanted = self.reference_generator.sample(now).pose, self.compliance.wanted
        C, stiff = reference.rotation @ wanted.frame, wanted.stiffness > 0
        away = C.T @ (state.tool.position - reference.position) * stiff[:3]
        turned = C.T @ log(state.tool.rotation @ reference.rotation.T) * stiff[3:]
        distance, angle = float(np.linalg.norm(away)), float(np.linalg.norm(turned))
        near = NEAR_M + float(np.linalg.norm(wanted.force)) / self._stiffness
        if distance <= near and angle <= NEAR_RAD:
            return None
        return f"the tool is {distance * 1e3:.0f} mm and {np.degrees(angle):.1f} deg away from where it shall be"
