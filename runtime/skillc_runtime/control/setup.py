"""The setup of an arm: everything that its driver needs besides measurements."""

from __future__ import annotations

from collections.abc import Callable

import msgspec
import mujoco

from skillc_runtime.control.gains import Gains
from skillc_runtime.control.supervision.safety import SafetyLimits
from skillc_runtime.devices.arm import Arm, ArmLimits
from skillc_runtime.motion.pose import Pose


class ArmSetup(msgspec.Struct, frozen=True):
    """One arm, the gains of its controller and the limits of its joints.

    `virtual` is of `load_virtual_model`; `base` returns the pose of the arm's base in the world, whose arrays may
    change; `period` is the control period in s. An arm that violates a limit of `safety` is held at once.
    """

    arm: Arm
    virtual: mujoco.MjModel
    gains: Gains
    limits: ArmLimits
    base: Callable[[], Pose]
    period: float
    safety: SafetyLimits = msgspec.field(default_factory=SafetyLimits)
