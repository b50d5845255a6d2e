"""What no skill may do to an arm or with it: limits on force, speed and place of the tool, from knowledge."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, sqrt

import numpy as np

from skillc_runtime.control.momentum_observer import MomentumObserver
from skillc_runtime.devices.arm import ArmState, Command, Torque
from skillc_runtime.motion.arrays import Matrix, Vector
from skillc_runtime.motion.numerics.compiled import compiled
from skillc_runtime.motion.numerics.linear import times, transposed_times
from skillc_runtime.motion.pose import Array, Pose

CHECK_PERIOD_S = 0.005
"""How often the limits are looked at."""


@dataclass(frozen=True, slots=True)
class Workspace:
    """A box: its middle and axes in the arm's base frame, its size (3,) in m."""

    middle: Pose
    size: Array

    def outside(self, point: Array) -> float:
        """Return how far in m a point (3,) of the base frame is outside; 0 within."""
        return distance_outside(point, self.middle.position, self.middle.rotation, self.size)


@dataclass(frozen=True, slots=True)
class SafetyLimits:
    """What makes an arm stop, whoever moves it.

    contact_force_n: of the tool on its surroundings; tool_speed_m_s: of the tool centre point; workspace: where that
    must stay, fixed to the arm's base, None for anywhere.
    """

    contact_force_n: float = inf
    tool_speed_m_s: float = inf
    workspace: Workspace | None = None


class SafetyMonitor:
    """Watches the limits of one arm; a violation is reported once, until the arm is within its limits again."""

    def __init__(self, limits: SafetyLimits, state: ArmState, torque: bool) -> None:
        self.limits = limits
        self.momentum_observer = MomentumObserver(state) if torque else None
        self._age, self._violated = 0.0, False

    def add_command(self, command: Command, bias: Array, period: float) -> None:
        """Take in what the arm is commanded for the next `period` s, and its bias (nv,) in N m."""
        if self.momentum_observer is not None and isinstance(command, Torque):
            self.momentum_observer.add_command(command.tau, bias, period)

    def violation(self, state: ArmState, period: float) -> str | None:
        """Return which limit is broken, once per violation; to be called every control period."""
        if self.momentum_observer is not None:
            self.momentum_observer.step(state, period)
        self._age += period
        if self._age < CHECK_PERIOD_S:
            return None
        self._age = 0.0
        found = self._violated_limit(state)
        news, self._violated = found is not None and not self._violated, found is not None
        return found if news else None

    def _violated_limit(self, state: ArmState) -> str | None:
        limits = self.limits
        felt = state.wrench if self.momentum_observer is None else self.momentum_observer.wrench(state)
        force = sqrt(felt[0] * felt[0] + felt[1] * felt[1] + felt[2] * felt[2])
        if force > limits.contact_force_n:
            return f"a force of {force:.0f} N on the tool is beyond the {limits.contact_force_n:g} N that the arm bears"
        speed = tool_speed(state.jacobian, state.dq)
        if speed > limits.tool_speed_m_s:
            return f"the tool moves with {speed:.2f} m/s, beyond the {limits.tool_speed_m_s:g} m/s that the arm may"
        outside = limits.workspace.outside(state.tool.position) if limits.workspace is not None else 0.0
        return f"the tool is {outside * 1e3:.0f} mm outside the arm's workspace" if outside > 0 else None


@compiled
def tool_speed(J: Matrix, dq: Vector) -> float:
    """Return the speed of the tool in m/s. J (6, nv): [linear m; angular rad] per rad; dq (nv,): rad/s."""
    twist = np.empty(6)
    times(J, dq, twist)
    return sqrt(twist[0] * twist[0] + twist[1] * twist[1] + twist[2] * twist[2])


@compiled
def distance_outside(point: Vector, middle: Vector, axes: Matrix, size: Vector) -> float:
    """Return how far in m a point is outside a box with axes (3, 3) and size (3,); 0 within."""
    away, along, square = np.empty(3), np.empty(3), 0.0
    for i in range(3):
        away[i] = point[i] - middle[i]
    transposed_times(axes, away, along)
    for i in range(3):
        outside = max(abs(along[i]) - size[i] / 2, 0.0)
        square += outside * outside
    return sqrt(square)
