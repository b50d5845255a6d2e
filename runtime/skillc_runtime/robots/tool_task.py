"""What the tool of an arm shall do, in the arm's base frame: where it shall be, how it yields and pushes."""

from __future__ import annotations

import numpy as np

from skillc_runtime.controllers.controller import Controller
from skillc_runtime.controllers.gains import Gains
from skillc_runtime.motion.guide import Guide
from skillc_runtime.motion.joint import JointReference
from skillc_runtime.motion.pose import Array, Pose, log
from skillc_runtime.robots.arm import ArmState, Command
from skillc_runtime.robots.yielding import Yielding

NEAR_M, NEAR_RAD = 0.005, 0.05
"""How far the tool may be from its reference to count as there; a pushing one may be behind by friction besides."""


class ToolTask:
    """The guide says where, `yielding` how; the two change together when something is released or restored.

    `reference` is that of the last control period.
    """

    def __init__(self, gains: Gains, law: Controller, tool: Pose) -> None:
        self.guide = Guide(tool, gains.acceleration_limit)
        self.yielding = Yielding(gains)
        self._stiffness, self._force_limit = gains.linear_stiffness, gains.force_limit
        self._law = law
        self.reference = self.guide.sample(0.0)

    def command(self, state: ArmState, now: float, period: float) -> Command:
        """Return what to tell the arm."""
        self.reference = self.guide.sample(now)
        return self._law.command(state, self.reference, self.yielding.compliance, period)

    def take_up(self, state: ArmState, joints: JointReference, tool: Pose, twist: Array, now: float) -> None:
        """Begin from joints where the tool is at `tool` and moves with a twist (6,), and come to rest."""
        self._law.reset(state, joints.q, joints.dq)
        self.guide.take_up(tool, twist, now)
        self.reference = self.guide.sample(now)

    def retake(self, state: ArmState, q: Array, now: float) -> None:
        """Hold the tool where it is: its centre point was moved on the hand."""
        self._law.reset(state, q, np.zeros_like(q))
        self.guide.take_up(self._law.tool, np.zeros(6), now)

    def hold(self, state: ArmState, q: Array, now: float) -> None:
        """Hold the tool where it is, at once: whatever moved it is given up, and it pushes no more."""
        self.guide.drop()
        self.retake(state, q, now)
        self.yielding.push_off()

    def let_go(self, now: float) -> None:
        """Let push and overlays fade."""
        self.yielding.push_off()
        self.guide.fade(now)

    @property
    def contact_wrench(self) -> Array:
        """What the environment does to the tool (6,), N and N m."""
        return self._law.contact_wrench

    def in_tool(self, direction: Array, now: float) -> Array:
        """Return a direction (3,) in the reference tool frame."""
        return self.guide.present(now).rotation.T @ direction

    def restore(self, now: float) -> None:
        """Undo the last release: hold the tool, along what it has yielded, where it is. Gives up a motion."""
        reference, wanted = self.guide.sample(now).pose, self.yielding.wanted
        away = self._law.tool.position - reference.position
        regained = reference.rotation @ self.yielding.regained()
        self.yielding.restore((reference.rotation @ wanted.frame).T @ away)
        resting = self.guide.present(now)
        place = Pose(resting.position + regained @ (regained.T @ away), resting.rotation)
        self.guide.place(place, np.eye(3) - regained @ regained.T, now)

    def push(self, direction: Array, force_n: float, fastest_m_s: float, now: float) -> None:
        """Press along a direction (3,), no faster; ValueError where the arm may not, or does not yield along it."""
        if not 0 <= force_n <= self._force_limit:
            raise ValueError(f"{force_n:g} N is beyond the {self._force_limit:g} N that the arm may push with")
        self.yielding.push(self.in_tool(direction, now), force_n, fastest_m_s)

    def restore_rotation(self, now: float) -> None:
        """Hold the tool in the rotation that it has. Gives up a motion."""
        self.yielding.turn_freely(False)
        resting = self.guide.present(now)
        self.guide.place(Pose(resting.position, self._law.tool.rotation), np.eye(3), now)

    def behind(self, state: ArmState, now: float) -> str | None:
        """Return how far the tool is from its reference along what it is to hold; None when near enough."""
        reference, wanted = self.guide.sample(now).pose, self.yielding.wanted
        C, stiff = reference.rotation @ wanted.frame, wanted.stiffness > 0
        away = C.T @ (state.tool.position - reference.position) * stiff[:3]
        turned = C.T @ log(state.tool.rotation @ reference.rotation.T) * stiff[3:]
        distance, angle = float(np.linalg.norm(away)), float(np.linalg.norm(turned))
        near = NEAR_M + float(np.linalg.norm(wanted.force)) / self._stiffness
        if distance <= near and angle <= NEAR_RAD:
            return None
        return f"the tool is {distance * 1e3:.0f} mm and {np.degrees(angle):.1f} deg away from where it shall be"
