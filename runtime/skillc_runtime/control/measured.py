"""The last measurement of an arm, in the world frame."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from skillc_runtime.devices.arm import ArmState
from skillc_runtime.devices.arm_driver import LinkTorque
from skillc_runtime.motion.pose import Array, Pose

NEAR_JOINT_RAD = 0.02
"""Error below which a joint has reached its reference."""

STILL_RAD_S = 0.03
"""Slower joints are at rest; the noise of a force sensor alone moves those of a compliant arm with 0.02 rad/s."""


class MeasuredArm:
    """The last state of an arm, implementing `ArmMeasurements`: world axes, SI units, arrays that are copies.

    `base` returns the pose of the arm's base in the world; `contact_wrench` the wrench (6,) of the environment on the
    tool as the control law knows it, N and N m, base axes. `state` is the measurement itself, in base; it is set once a
    control period. `felt_wrench` returns what is measured of that wrench, and never what is commanded; None where
    nothing measures it. `has_link_sensors` says whether the measured effort is that between gears and links.
    """

    def __init__(self, base: Callable[[], Pose], contact_wrench: Callable[[], Array], state: ArmState) -> None:
        self.base, self.state = base, state
        self._find_contact_wrench = contact_wrench
        self.felt_wrench: Callable[[], Array | None] = lambda: None
        self.has_link_sensors = False

    @property
    def pose(self) -> Pose:
        """The tool centre point in the world."""
        return self.base() @ self.state.tool

    @property
    def velocity(self) -> Array:
        """The twist (6,) of the tool, [linear m/s; angular rad/s], world axes."""
        return self._in_world(self.state.jacobian @ self.state.dq)

    @property
    def wrench(self) -> Array:
        """What is `felt`; where nothing measures it, the wrench (6,) of the environment that the law is to exert."""
        felt = self.felt
        return self._in_world(self._find_contact_wrench()) if felt is None else felt

    @property
    def pressing_n(self) -> float:
        """The force in N with which the tool presses along its axis, by `wrench`; it is the same in all axes."""
        felt = self.felt_wrench()
        wrench = self._find_contact_wrench() if felt is None else felt
        return -float(wrench[:3] @ self.state.tool.rotation[:, 2])

    @property
    def contact_wrench(self) -> Array:
        """The wrench (6,) of the environment on the tool as the control law knows it, N and N m, base axes."""
        return self._find_contact_wrench()

    @property
    def felt(self) -> Array | None:
        """The wrench (6,) by a sensor or by the torques of the joints, N and N m, world axes; None without either."""
        felt = self.felt_wrench()
        return None if felt is None else self._in_world(felt)

    @property
    def link_torque(self) -> LinkTorque | None:
        """What torque sensors between gears and links tell; None without them."""
        if not self.has_link_sensors:
            return None
        state, turned = self.state, np.kron(np.eye(2), self.base().rotation)
        return LinkTorque(state.bias - state.effort, state.bias.copy(), turned @ state.jacobian)

    @property
    def q(self) -> Array:
        """The joints (nv,) in rad."""
        return self.state.q.copy()

    @property
    def still(self) -> bool:
        """Whether all joints are at rest."""
        return is_still(self.state.dq)

    def at_joints(self, q: Array) -> bool:
        """Tell whether the joints are at q (nv,) in rad."""
        return bool(np.abs(self.state.q - q).max() < NEAR_JOINT_RAD)

    def in_world(self, point: Array) -> Array:
        """Return a point (3,) in m of the arm's base frame in the world frame."""
        return self.base().apply(point)

    def in_base(self, direction: Array) -> Array:
        """Return a direction (3,) of the world in the axes of the arm's base."""
        return self.base().rotation.T @ direction

    def _in_world(self, vector: Array) -> Array:
        return (vector.reshape(2, 3) @ self.base().rotation.T).ravel()


def is_still(dq: Array) -> bool:
    """Tell whether joints with the speeds dq (nv,) in rad/s are at rest."""
    return bool(np.abs(dq).max() < STILL_RAD_S)
