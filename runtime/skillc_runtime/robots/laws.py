"""The laws of one arm; they share its limits, so that changing between them is smooth."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_runtime.controllers.controller import Controller, JointController
from skillc_runtime.controllers.limits import JointLimit, TorqueLimit
from skillc_runtime.motion.pose import Array
from skillc_runtime.robots.arm import ArmState


@dataclass(frozen=True, slots=True)
class Laws:
    """One law for the tool, one for the joints, and what both obey."""

    tool: Controller
    joints: JointController
    limit: TorqueLimit | JointLimit

    def joints_now(self, state: ArmState) -> Array:
        """Return the joints (nv,) from which a motion goes on: those commanded last, else the measured ones."""
        return (self.limit.q if isinstance(self.limit, JointLimit) else state.q).copy()

    def joints_held(self, state: ArmState) -> Array:
        """Return the joints (nv,) at which the arm holds still when it is to do so at once."""
        return (self.limit.held(state) if isinstance(self.limit, JointLimit) else state.q).copy()

    def speeds_now(self, state: ArmState) -> Array:
        """Return the joint speeds (nv,) with which a motion goes on: those commanded last, else the measured ones."""
        return (self.limit.dq if isinstance(self.limit, JointLimit) else state.dq).copy()
