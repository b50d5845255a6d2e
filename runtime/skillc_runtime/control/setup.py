"""What an arm is set up with: all that drives it must know of it besides what it measures."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import mujoco

from skillc_runtime.control.gains import Gains
from skillc_runtime.control.safety import SafetyLimits
from skillc_runtime.devices.arm import Arm, ArmLimits
from skillc_runtime.motion.pose import Pose


@dataclass(frozen=True, slots=True)
class ArmSetup:
    """One arm, the gains of its controller and the limits of its joints.

    `virtual` is the arm's `virtual_model`, `base` returns where the arm stands in the world, `period` s is from one
    command to the next. An arm that breaks a limit of `safety` holds still at once, whoever moves it.
    """

    arm: Arm
    virtual: mujoco.MjModel
    gains: Gains
    limits: ArmLimits
    base: Callable[[], Pose]
    period: float
    safety: SafetyLimits = field(default_factory=SafetyLimits)
