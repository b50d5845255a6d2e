"""What can happen to a simulated cell that no skill does."""

from skillc_runtime.devices.disturbances import Disturbance

__all__ = ["Disturbance"]
