"""The force with which a tool presses, as its arm measures it; what it is only commanded to exert is an assumption."""

from __future__ import annotations

from skillc_runtime.devices.arm_driver import ArmMeasurements
from skillc_runtime.world.state.evidence import Evidence


def pressing_force_n(measured: ArmMeasurements) -> float:
    """Return the force in N along the z axis of the tool, out of it; the commanded one where nothing measures it."""
    felt = measured.felt
    wrench = measured.wrench if felt is None else felt
    return -float(wrench[:3] @ measured.pose.rotation[:, 2])


def force_evidence(measured: ArmMeasurements) -> Evidence:
    """Return how such a force is known."""
    return "assumed" if measured.felt is None else "sensed"
