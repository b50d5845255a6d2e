"""A gripper that ROS 2 drives: what its fingers do is told by the position of its first joint."""

from __future__ import annotations

from functools import partial
from time import monotonic
from typing import Any

import numpy as np

from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.devices.measured_gripper import MeasuredGripper
from skillc_runtime.backends.ros2.arms.joint_states import JointOrder
from skillc_runtime.backends.ros2.facts import GripperInterface
from skillc_runtime.backends.ros2.finger_commands import make_finger_commands
from skillc_runtime.backends.ros2.receiver import Receiver
from skillc_runtime.backends.simulation.scene_spec import GripperSpec

STILL_M, STILL_S = 0.0005, 0.25
"""Fingers that have moved no further for this time are at rest."""
BEGIN_S, REPEAT_S = 0.5, 0.05
"""How long fingers may take to begin to move, and how often their command is repeated until then, in s."""
NEAR_M = 0.002
MISFIT_M = 0.02
"""How far beyond their ends fingers may seem to be, by play and calibration."""


class Ros2Gripper(MeasuredGripper):
    """One gripper. Whether it is blocked is told by its opening: ROS has no common message for that."""

    def __init__(
        self, facts: GripperSpec, interface: GripperInterface, arm: RemoteArmDriver, receiver: Receiver
    ) -> None:
        """Subscribe to its joints; it can be used once the receiver has begun."""
        super().__init__(interface.name, facts, arm.hold, partial(arm.set_load, None))
        self._interface, self._receiver = interface, receiver
        self._order = JointOrder(interface.joints[:1])
        quality = interface.quality
        self.feed = receiver.feed(interface.states, "sensor_msgs/msg/JointState", quality.reliable_states, self._take)
        self._commands = make_finger_commands(interface, receiver.session)
        self._opening_m = self._goal_m = self._rested_at_m = facts.first_opening_m
        self._moved_s = self._commanded_s = self._sent_s = -np.inf
        self._is_idle = True
        self._fault: str | None = None

    @property
    def opening_m(self) -> float:
        """The measured distance between the fingers in m."""
        with self._receiver.lock:  # wait ends: with the messages that have arrived
            return self._opening_m

    @property
    def moving(self) -> bool:
        """Whether the fingers still move towards the commanded opening."""
        has_begun = self._moved_s > self._commanded_s
        rests_at = self._moved_s + STILL_S if has_begun else self._commanded_s + BEGIN_S
        if not self._is_idle and monotonic() > rests_at:
            self._is_idle = True
        return not self._is_idle

    @property
    def blocked(self) -> bool:
        """Whether the fingers rest, wider than their commanded opening."""
        return not self.moving and self.opening_m > self._goal_m + NEAR_M + self.opening_error_m

    @property
    def fault(self) -> str | None:
        """Why it has not done what it was told, or is not the gripper of its facts; None if it has, and is."""
        return self._fault

    def recover(self) -> None:
        """Forget that it has not done what it was told: somebody has acknowledged that."""
        with self._receiver.lock:  # wait ends: with the messages that have arrived
            self._commands.forget()
            self._fault = self._find_misfit()

    def move(self, opening_m: float, force_n: float) -> None:
        """Move the fingers to an opening in m with at most a force in N; returns at once."""
        now_m, widest_m = self.opening_m, self._facts.max_opening_m
        self._goal_m = self._commands.aim(min(max(opening_m, 0.0), widest_m), now_m, widest_m)
        self._is_idle, self._commanded_s = False, monotonic()
        self._commands.send(self._goal_m, min(force_n, self._facts.max_force_n))

    def stop(self) -> None:
        """Stop the fingers at their present opening; those that services move go on."""
        self._goal_m = self.opening_m
        self._commands.stop(self._goal_m)
        self._is_idle = True

    def _take(self, message: Any) -> None:
        self._fault = self._commands.look() or self._find_misfit()
        if not self._order.read(message) or self._order.missing:
            return
        self._opening_m = self._interface.opening(float(self._order.positions[0]))
        now = monotonic()
        if abs(self._opening_m - self._rested_at_m) > STILL_M:
            self._rested_at_m, self._moved_s = self._opening_m, now
        elif not self._is_idle and self._moved_s < self._commanded_s and now > self._sent_s + REPEAT_S:
            self._sent_s = now
            self._commands.repeat()

    def _find_misfit(self) -> str | None:
        """Return that the fingers are where those of the model cannot be."""
        widest_m = self._facts.max_opening_m
        if -MISFIT_M < self._opening_m < widest_m + MISFIT_M:
            return None
        return (
            f"{self._interface.name} is {self._opening_m:.3f} m open by its facts, and opens to {widest_m:.3f} m at "
            "most: correct ros2:openingPerUnit and ros2:openingAtZero"
        )
