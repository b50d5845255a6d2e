"""What a robot says of itself, its mode and its errors, as the condition of an arm with a sentence for people."""

from __future__ import annotations

import re
from types import MappingProxyType
from typing import Any

from skillc_runtime.backends.control_process.link import DeviceCondition

CAUSES = MappingProxyType(
    {
        "joint_reflex": "the torque on a joint was above what counts as a collision",
        "cartesian_reflex": "the force on the tool was above what counts as a collision",
        "communication_constraints_violation": "too many commands came late or not at all",
        "controller_torque_discontinuity": "the commanded torque jumped",
        "joint_velocity_violation": "a joint was too fast",
        "joint_position_limits_violation": "a joint was at the end of its range",
        "cartesian_velocity_violation": "the tool was too fast",
        "self_collision_avoidance_violation": "the arm came too close to itself",
        "tau_J_range_violation": "the torque in a joint was beyond what its sensor measures",
        "power_limit_violation": "the arm needed too much power",
        "instability_detected": "the motion was not stable",
    }
)
"""What the names of the robot's errors mean, as libfranka documents them (errors.h)."""

READY, IN_CONTROL = DeviceCondition("ready"), DeviceCondition("in-control")
MODES = MappingProxyType(
    {
        "Move": DeviceCondition("not-in-control", "another program or an app in Desk moves the robot; end it"),
        "Guiding": DeviceCondition(
            "wrong-mode", "the robot is guided by hand; let go of its buttons and leave that mode"
        ),
        "UserStopped": DeviceCondition(
            "emergency-stop", "the robot was stopped by its stop button or enabling device; release it"
        ),
        "AutomaticErrorRecovery": DeviceCondition("wrong-mode", "the robot recovers from an error; wait"),
        "Other": DeviceCondition(
            "wrong-mode", "the robot takes no commands: unlock its joints and activate FCI in Desk, in Execution mode"
        ),
    }
)
"""The conditions of a robot that neither waits for a command nor has stopped by a reflex, by the name of its mode."""


def read_condition(state: Any, controls: bool) -> DeviceCondition:
    """Return the condition by a state of the robot; `controls` is whether this program has control."""
    mode = state.robot_mode.name
    if mode == "Reflex":
        return DeviceCondition("protective-stop", describe_stop(state.current_errors or state.last_motion_errors))
    if mode == "Idle" or (mode == "Move" and controls):
        return IN_CONTROL if controls else READY
    return MODES[mode]


def describe_stop(errors: Any) -> str:
    """Return in a sentence why the robot has stopped."""
    names = re.findall(r"\w+", str(errors))
    causes = ", ".join(f"{CAUSES[name]} ({name})" if name in CAUSES else name for name in names)
    return f"the robot has stopped by a reflex: {causes or 'it names no error'}"
