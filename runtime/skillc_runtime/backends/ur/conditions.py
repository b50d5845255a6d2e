"""What the states that a controller reports mean for a program that wants to move its arm."""

from __future__ import annotations

from typing import Final

from skillc_runtime.backends.control_process.link import DeviceCondition

RUNNING: Final = 7
"""The `robot_mode` of an arm with power and without brakes."""

PLAYING: Final = 2
"""The `runtime_state` of a controller that executes a program."""

PROTECTIVE_STOP, SAFEGUARD_STOP, EMERGENCY_STOP, VIOLATION, FAULT = 2, 4, 7, 8, 9
"""Bits of `safety_status_bits` (guide to the Real-Time Data Exchange)."""

ROBOT_MODES: Final = {
    -1: "has no controller", 0: "is disconnected", 1: "waits for the confirmation of its safety settings",
    2: "is booting", 3: "has no power", 4: "is being switched on", 5: "has its brakes on", 6: "is in backdrive",
    8: "is updating its firmware",
}  # fmt: skip
"""The other robot modes."""

READY: Final = DeviceCondition("ready")
IN_CONTROL: Final = DeviceCondition("in-control")


def read_condition(name: str, safety_bits: int, robot_mode: int, runtime: int, *, controls: bool) -> DeviceCondition:
    """Return the condition of a controller; `controls`: whether the program that it executes is ours."""
    stop = _read_stop(name, safety_bits)
    if stop is not None:
        return stop
    if robot_mode != RUNNING:
        what = ROBOT_MODES.get(robot_mode, f"is in robot mode {robot_mode}")
        return DeviceCondition("wrong-mode", f"{name} {what}: switch it on and release its brakes at its panel")
    if controls and runtime == PLAYING:
        return IN_CONTROL
    if controls:
        return DeviceCondition(
            "not-in-control",
            f"the program that moves {name} has ended: somebody has stopped it or switched the panel to local "
            "control, or commands were missing for longer than ur:commandTimeout",
        )
    if runtime == PLAYING:
        return DeviceCondition("not-in-control", f"{name} executes another program: stop that at its panel first")
    return READY


def _read_stop(name: str, bits: int) -> DeviceCondition | None:
    """Return why the safety system has stopped the arm; None if it has not."""
    if bits >> EMERGENCY_STOP & 1:
        return DeviceCondition(
            "emergency-stop",
            f"the emergency stop of {name} is pressed: release it, then switch the arm on at its panel",
        )
    if bits >> VIOLATION & 1 or bits >> FAULT & 1:
        return DeviceCondition(
            "protective-stop", f"the safety system of {name} reports a fault: read it and restart it at the panel"
        )
    if bits >> SAFEGUARD_STOP & 1:
        return DeviceCondition("protective-stop", f"the safeguard stop of {name} is active: somebody is in its cell")
    if bits >> PROTECTIVE_STOP & 1:
        return DeviceCondition(
            "protective-stop",
            f"{name} has stopped by itself (protective stop): a limit of its safety system, or a collision; its panel "
            "says which",
        )
    return None
