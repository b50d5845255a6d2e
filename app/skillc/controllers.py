"""What a control law of your own is made of; `docs/how-to/own-controller.md` shows one."""

from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.laws.own_law import LawSetup, OwnLaw
from skillc_runtime.devices.arm import ArmState, JointPosition, JointVelocity, Torque
from skillc_runtime.motion.pose import Pose
from skillc_runtime.motion.pose import log as rotation_vector
from skillc_runtime.motion.reference import Compliance, Reference

__all__ = [
    "ArmState",
    "Compliance",
    "ControlError",
    "JointPosition",
    "JointVelocity",
    "LawSetup",
    "OwnLaw",
    "Pose",
    "Reference",
    "Torque",
    "rotation_vector",
]
