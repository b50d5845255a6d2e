"""The task of an arm's tool, in the arm's base frame: its reference, compliance and push."""

from __future__ import annotations

import numpy as np

from skillc_runtime.control.compliance_state import ComplianceState
from skillc_runtime.control.controller import Controller
from skillc_runtime.control.gains import Gains
from skillc_runtime.devices.arm import ArmState, Command
from skillc_runtime.motion.paths.joint import JointReference
from skillc_runtime.motion.pose import Array, Pose, log
from skillc_runtime.motion.reference import Reference
from skillc_runtime.motion.reference_generator import ReferenceGenerator
from skillc_runtime.motion.shift import NO_SHIFT, Shift, constant_shift

NEAR_M, NEAR_RAD = 0.005, 0.05
"""Error below which the tool has reached its reference; while it pushes, friction may add to it."""

RETURN_M_S, RETURN_M_S2 = 0.02, 0.05
"""Speed and acceleration with which the reference returns to its motion after a hold: released axes yield meanwhile."""


class ToolTask:
    """Reference and compliance of the tool; releases and restores change both.

    Times `now` are in s, directions (3,) unit vectors.
    """

    def __init__(self, gains: Gains, law: Controller, tool: Pose) -> None:
        """Begin with the tool at rest where it is, in the base frame."""
        self.reference_generator = ReferenceGenerator(tool, gains.limits.acceleration_m_s2)
        self.compliance = ComplianceState(gains)
        self._stiffness, self._force_limit = gains.linear_stiffness, gains.limits.force_n
        self._law = law
        self._acceleration_m_s2 = gains.limits.acceleration_m_s2
        self._shift = NO_SHIFT
        self.reference_generator.sample(0.0)

    @property
    def reference(self) -> Reference:
        """The last sample of the reference, in base; its arrays change."""
        return Reference(self.reference_generator.plan.rows)

    def command(self, state: ArmState, now: float, period: float) -> Command:
        """Return the command for the next `period` s."""
        self._sample(now)
        return self._law.command(state, self.reference, self.compliance.applied, period)

    def restart_from(self, state: ArmState, joints: JointReference, tool: Pose, twist: Array, now: float) -> None:
        """Come to rest from joints with the tool at a pose and with a twist.

        tool: pose in the base frame.
        twist: (6,) in m/s and rad/s, base axes.
        now: s.
        """
        self._set_shift(NO_SHIFT)
        self._law.reset(state, joints.q, joints.dq)
        self.reference_generator.restart_from(tool, twist, now)
        self.reference_generator.sample(now)

    def restart_here(self, state: ArmState, q: Array, now: float) -> None:
        """Hold the tool at its present pose, with joints q (nv,) in rad, after it was moved on the hand."""
        self._set_shift(NO_SHIFT)
        self._law.reset(state, q, np.zeros_like(q))
        self.reference_generator.restart_from(self._law.tool, np.zeros(6), now)

    def hold(self, state: ArmState, q: Array, now: float) -> None:
        """Hold the tool at its present pose, with joints q (nv,) in rad, at once; end motions, overlays and push."""
        self.reference_generator.drop_overlays()
        self.restart_here(state, q, now)
        self.compliance.push_off()

    def let_go(self, now: float) -> None:
        """Fade push and overlays out."""
        self.compliance.push_off()
        self.reference_generator.fade_overlays(now)

    @property
    def contact_wrench(self) -> Array:
        """The wrench (6,) of the environment on the tool, N and N m, base axes."""
        return self._law.contact_wrench

    def in_tool(self, direction: Array, now: float) -> Array:
        """Return a direction (3,) of the base frame in the reference tool frame."""
        return self.reference_generator.path_pose(now).rotation.T @ direction

    def restore(self, now: float) -> None:
        """Undo the last release: hold the tool, along the released axis, where it is now. Abandons a motion."""
        reference, away = self._error(now)
        regained = reference.rotation @ self.compliance.regained_axes()
        self.compliance.restore((reference.rotation @ self.compliance.wanted.frame).T @ away)
        resting = self.reference_generator.path_pose(now)
        beside = regained @ (regained.T @ (away + self._shift.at(now)[0]))
        kept = np.eye(3) - regained @ regained.T
        self.reference_generator.jump_to(Pose(resting.position + beside, resting.rotation), kept, now)
        self._set_shift(self._shift.project(kept))

    def hold_released(self, now: float) -> None:
        """Hold the tool, along released axes, where it is now, without a push. The motion is kept, beside the tool."""
        reference, away = self._error(now)
        released = reference.rotation @ self.compliance.released_axes()
        self.compliance.hold((reference.rotation @ self.compliance.wanted.frame).T @ away)
        self._set_shift(constant_shift(self._shift.at(now)[0] + released @ (released.T @ away)))

    def lift(self, way: Array, speed: float, now: float) -> None:
        """Move the held tool beside its motion.

        way: (3,) in m, in base.
        speed: m/s.
        now: s.
        """
        self._set_shift(self._shift.towards(self._shift.at(now)[0] + way, speed, self._acceleration_m_s2, now))

    def let_go_released(self, now: float) -> None:
        """Let released axes yield again after `hold_released`; the tool returns to its motion along the others."""
        self.compliance.let_go()
        self._set_shift(self._shift.towards(np.zeros(3), RETURN_M_S, RETURN_M_S2, now))

    def lifting(self, now: float) -> bool:
        """Tell whether the tool moves beside its motion."""
        return not self._shift.done(now)

    def stationary(self, now: float) -> bool:
        """Tell whether the reference stands still."""
        return self._shift.done(now) and self.reference_generator.stationary(now)

    def _sample(self, now: float) -> Reference:
        if self._shift is not NO_SHIFT and self._shift.is_over(now):
            self._set_shift(NO_SHIFT)
        return self.reference_generator.sample(now)

    def _set_shift(self, shift: Shift) -> None:
        self._shift = shift
        self.reference_generator.set_shift(None if shift is NO_SHIFT else shift)

    def _error(self, now: float) -> tuple[Pose, Array]:
        """Return the pose of the reference, and the tool's position (3,) relative to it in m, in base."""
        reference = self._sample(now).pose
        return reference, self._law.tool.position - reference.position

    def push(self, direction: Array, force_n: float, fastest_m_s: float, now: float) -> None:
        """Push along a direction; ValueError if the force is not allowed or the direction not released.

        direction: (3,), a unit vector in base.
        force_n: N.
        fastest_m_s: m/s, of the tool along the direction.
        now: s.
        """
        if not 0 <= force_n <= self._force_limit:
            raise ValueError(f"{force_n:g} N is beyond the {self._force_limit:g} N that the arm may push with")
        self.compliance.push(self.in_tool(direction, now), force_n, fastest_m_s)

    def restore_rotation(self, now: float) -> None:
        """Hold the present rotation of the tool. Abandons a motion."""
        self.compliance.set_rotation_free(False)
        resting = self.reference_generator.path_pose(now)
        self.reference_generator.jump_to(Pose(resting.position, self._law.tool.rotation), np.eye(3), now)

    def tracking_error_message(self, state: ArmState, now: float) -> str | None:
        """Return a message about the error of the tool along stiff axes; None if it is small."""
        reference, wanted = self._sample(now).pose, self.compliance.wanted
        C, stiff = reference.rotation @ wanted.frame, wanted.stiffness > 0
        away = C.T @ (state.tool.position - reference.position) * stiff[:3]
        turned = C.T @ log(state.tool.rotation @ reference.rotation.T) * stiff[3:]
        distance, angle = float(np.linalg.norm(away)), float(np.linalg.norm(turned))
        near = NEAR_M + float(np.linalg.norm(wanted.force)) / self._stiffness
        if distance <= near and angle <= NEAR_RAD:
            return None
        return f"the tool is {distance * 1e3:.0f} mm and {np.degrees(angle):.1f} deg away from where it shall be"
