"""Checks every measurement and every command between a driver and its arm, and the arm's safety limits.

Values that are not finite are neither used nor commanded.
"""

from __future__ import annotations

from typing import NoReturn, assert_never

import numpy as np

from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.supervision.safety import SafetyLimits, SafetyMonitor
from skillc_runtime.devices.arm import Arm, ArmState, Command, JointPosition, JointVelocity, Torque, command_values
from skillc_runtime.motion.arrays import OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled
from skillc_runtime.motion.numerics.linear import copy_vector, squared
from skillc_runtime.motion.pose import Array


@compiled
def sum_of_squares(x: Vector) -> float:
    """Return the sum of the squares of x (n,), in any unit: not finite if one of them is not."""
    return squared(x)


class CommandValidator:
    """Checks what one arm measures and is commanded, and holds its last known position if a check fails.

    holds (nv,): what holds it there, N m or rad; one array, which changes.
    """

    def __init__(self, arm: Arm, state: ArmState, limits: SafetyLimits | None = None) -> None:
        self._arm = arm
        self.safety = SafetyMonitor(limits or SafetyLimits(), state, arm.interface, arm.capabilities)
        self.holds = self._rest(state).copy()

    def check(self, state: ArmState) -> None:
        """Check a measured state. ControlError if a value is not finite; the arm is commanded to hold first."""
        if not update_holding(self.holds, self._rest(state), state.q, state.dq, state.wrench, state.tool.position):
            self.refuse_measurement()

    def command(self, command: Command, period: float) -> None:
        """Command the arm for the next `period` s.

        ControlError if a value is not finite; the arm is commanded to hold instead.
        """
        if not sum_of_squares(command_values(command)) < np.inf:
            self.refuse_command()
        self.safety.add_command(command, self.holds, period)
        self._arm.command(command)

    def refuse_measurement(self) -> NoReturn:
        """Command the arm to hold and raise ControlError, for a measurement that is not finite."""
        self._give_up("the arm reports something that is not a number")

    def refuse_command(self) -> NoReturn:
        """Command the arm to hold and raise ControlError, for a command that is not finite."""
        self._give_up("the control law does not yield a number")

    def holding(self) -> Command:
        """Return the command that holds the last known position."""
        match self._arm.interface:
            case "torque":
                return Torque(self.holds.copy())
            case "position":
                return JointPosition(self.holds.copy())
            case "velocity":
                return JointVelocity(np.zeros_like(self.holds))
            case never:
                assert_never(never)

    def _rest(self, state: ArmState) -> Array:
        """Return the values (nv,) that hold the arm: bias torques in N m, or joints in rad for an arm with servos."""
        return state.bias if self._arm.interface == "torque" else state.q

    def _give_up(self, reason: str) -> NoReturn:
        self._arm.command(self.holding())
        raise ControlError(reason)


@compiled
def update_holding(holding: OutVector, rest: Vector, q: Vector, dq: Vector, wrench: Vector, position: Vector) -> bool:
    """Copy `rest` to `holding`, and return True if all other values are finite; else return False.

    holding: (nv,) in N m or rad.
    rest: (nv,) in N m or rad.
    q: (nv,) in rad.
    dq: (nv,) in rad/s.
    wrench: (6,) in N and N m, in the base frame.
    position: (3,) in m, in the base frame.
    """
    finite = squared(q) + squared(dq) + squared(wrench) + squared(position) < np.inf
    if finite:
        copy_vector(rest, holding)
    return bool(finite)
