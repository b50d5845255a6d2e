"""What devices are: the protocols that primitives use and back ends fulfil, and how simulated ones are disturbed."""

from skillc_runtime.devices.arm import Arm
from skillc_runtime.devices.backend import Backend, BackendStart, BackendUnavailable, DeviceStop, StopPersists
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.devices.camera import PoseCamera
from skillc_runtime.devices.capabilities import BackendCapabilities
from skillc_runtime.devices.cell import Cell
from skillc_runtime.devices.disturbances import LoseArm, MoveThing, PressEmergencyStop, PushArm, TakeThing
from skillc_runtime.devices.gripper import Gripper

__all__ = [
    "Arm",
    "Backend",
    "BackendCapabilities",
    "BackendStart",
    "BackendUnavailable",
    "Cell",
    "DeviceStop",
    "Gripper",
    "LoseArm",
    "MobileBase",
    "MoveThing",
    "PoseCamera",
    "PressEmergencyStop",
    "PushArm",
    "StopPersists",
    "TakeThing",
]
