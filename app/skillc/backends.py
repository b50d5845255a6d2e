"""The cells that tasks can run in."""

from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.real_time.cell import RealTimeCell
from skillc_runtime.backends.real_time.device_cell import CellDevices, DeviceCell
from skillc_runtime.backends.symbolic.cell import SymbolicCell

__all__ = ["CellDevices", "DeviceCell", "KinematicCell", "RealTimeCell", "SimulatedCell", "SymbolicCell"]
