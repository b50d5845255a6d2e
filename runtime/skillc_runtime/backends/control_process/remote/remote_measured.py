"""What the control process of an arm has measured last, in the world frame."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from skillc_runtime.backends.control_process.remote.host import ControlProcess
from skillc_runtime.control.measured import MeasuredArm
from skillc_runtime.devices.arm import ArmState
from skillc_runtime.motion.pose import Array, Pose


class RemoteMeasured:
    """Implements `ArmMeasurements`; `base` returns the pose of the arm's base in the world."""

    def __init__(self, process: ControlProcess, base: Callable[[], Pose]) -> None:
        self._process, self._base = process, base

    @property
    def state(self) -> ArmState:
        """The last measurement, in the axes of the arm's base."""
        return self._process.read().state

    @property
    def pose(self) -> Pose:
        """The tool centre point in the world."""
        return self._now().pose

    @property
    def velocity(self) -> Array:
        """The twist (6,) of the tool, [linear m/s; angular rad/s], world axes."""
        return self._now().velocity

    @property
    def wrench(self) -> Array:
        """What is `felt`; where nothing measures it, the wrench (6,) of the environment that the law is to exert."""
        return self._now().wrench

    @property
    def pressing_n(self) -> float:
        """The force in N with which the tool presses along its axis, by `wrench`."""
        return self._now().pressing_n

    @property
    def felt(self) -> Array | None:
        """The wrench (6,) by a sensor or by the torques of the joints, N and N m, world axes; None without either."""
        return self._now().felt

    @property
    def q(self) -> Array:
        """The joints (nv,) in rad."""
        return self._process.read().field("q").copy()

    @property
    def still(self) -> bool:
        """Whether all joints are at rest."""
        return self._now().still

    def at_joints(self, q: Array) -> bool:
        """Tell whether the joints are at q (nv,) in rad."""
        return self._now().at_joints(q)

    def in_world(self, point: Array) -> Array:
        """Return a point (3,) in m of the arm's base frame in the world frame."""
        return self._base().apply(point)

    def _now(self) -> MeasuredArm:
        snapshot = self._process.read()
        felt, contact = snapshot.felt, snapshot.field("contact")
        found = MeasuredArm(self._base, lambda: np.asarray(contact), snapshot.state)
        found.felt_wrench = lambda: felt
        return found
