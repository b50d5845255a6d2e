"""Where an arm's tool gets to: forward and inverse kinematics with whatever is in its hand at the moment."""

from __future__ import annotations

import mujoco

from skillc_runtime.controllers.virtual_arm import VirtualArm
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Trajectory
from skillc_runtime.robots.arm import ArmLimits, ArmState
from skillc_runtime.robots.feasible import feasible
from skillc_runtime.robots.inverse import inverse


class Reach:
    """Kinematics in the arm's base frame; a state tells where the tool centre point is on the hand."""

    def __init__(self, virtual: mujoco.MjModel) -> None:
        self._arm = VirtualArm(virtual)

    def tool_at(self, q: Array, state: ArmState) -> tuple[Pose, Array]:
        """Return the tool and its Jacobian (6, nv) at joints q (nv,)."""
        self._arm.mount(state.q, state.tool)
        self._arm.move(q)
        return self._arm.tool, self._arm.jacobian.copy()

    def feasible(self, trajectory: Trajectory, q: Array, limits: ArmLimits, state: ArmState) -> Trajectory:
        """Return a motion from joints q (nv,), slowed where a joint would be too fast; Infeasible where none fits."""
        self._arm.mount(state.q, state.tool)
        return feasible(self._arm, trajectory, q, limits)

    def joints_for(self, target: Pose, seed: Array, limits: Array, state: ArmState) -> Array | None:
        """Return joints (nv,) within limits (nv, 2) that put the tool at `target`, near `seed`; or None."""
        self._arm.mount(state.q, state.tool)
        return inverse(self._arm, target, seed, limits)
