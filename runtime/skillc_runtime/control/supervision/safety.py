"""Safety limits of an arm: contact force, speed and workspace of its tool, whichever skill moves it."""

from __future__ import annotations

from math import inf, sqrt

import msgspec
import numpy as np

from skillc_runtime.control.momentum_observer import (
    DAMPING,
    MEASURING,
    MomentumObserver,
    ObserverMemory,
    add_impulse,
    estimate_wrench,
    find_unexplained_torque,
    observe_momentum,
)
from skillc_runtime.control.supervision.signal_memory import (
    COMMANDED,
    COMPARES,
    FEELS,
    KNOWN,
    MOST_N,
    REPEATS,
    SignalMemory,
    describe_signals,
    make_signal_memory,
)
from skillc_runtime.devices.arm import ArmState, Capabilities, Command, Mode, Torque
from skillc_runtime.motion.arrays import Matrix, OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import copy_vector, times, transposed_times
from skillc_runtime.motion.pose import Array, Pose

CHECK_PERIOD_S = 0.005
"""Period with which limits are checked."""


class Workspace(msgspec.Struct, frozen=True):
    """A box that the tool must not leave: the pose of its centre in the arm's base frame, its size (3,) in m."""

    middle: Pose
    size: Array

    def outside(self, point: Array) -> float:
        """Return the distance in m of a point (3,) of the base frame from the box; 0 inside."""
        return distance_outside(point, self.middle.position, self.middle.rotation, self.size)


class SafetyLimits(msgspec.Struct, frozen=True):
    """Limits beyond which an arm is stopped.

    contact_force_n: of the tool on its surroundings; collision_torque_n_m: at a joint, explained neither by its motion
    nor by a force on the tool; tool_speed_m_s: of the tool centre point; workspace: which the
    tool centre point must not leave, in the base frame, None for no limit; force_drift_n_s: of what its force sensor
    feels of nothing, of which it is told after it was tared.
    """

    contact_force_n: float = inf
    collision_torque_n_m: float = inf
    tool_speed_m_s: float = inf
    workspace: Workspace | None = None
    force_drift_n_s: float = inf


FORCE, TORQUE, SPEED, TAKES_TORQUES, MEASURES_EFFORT, OBSERVES, FEELS_FORCE, IN_SPACE = range(8)
"""Entries of `SafetyMemory.limits`: the limits in N, N m and m/s, and what the arm is like, 0 or 1."""

AGE, VIOLATED, BEGUN = 0, 1, 2
"""Entries of `SafetyMemory.clock`: s since the last check, 1 if a limit was violated then, and 1 from the second period
on: the effort that is measured first is of no period."""


class SafetyMemory(msgspec.Struct, frozen=True):
    """The limits of one arm, and what is kept between control periods.

    limits (8,), clock (3,): see above; middle (3,), axes (3, 3), size (3,): of the workspace, in m, in base.
    """

    limits: OutVector
    middle: OutVector
    axes: OutMatrix
    size: OutVector
    clock: OutVector
    observer: ObserverMemory
    signals: SignalMemory


@inlined
def check_limits(memory: SafetyMemory, state: ArmState, period: float) -> bool:
    """Observe momentum; tell once per violation that a limit is violated. To be called every `period` s."""
    limits, clock = memory.limits, memory.clock
    if limits[MEASURES_EFFORT] != 0.0 and clock[BEGUN] == 0.0:
        copy_vector(state.dq, memory.observer.dq)
        memory.observer.elapsed[0] += period  # windows end when limits are checked
    elif limits[OBSERVES] != 0.0:
        if limits[MEASURES_EFFORT] != 0.0:
            add_impulse(memory.observer.impulse, state.effort, state.bias, period)
        observe_momentum(memory.observer, state, period)
    clock[BEGUN] = 1.0
    clock[AGE] += period
    if clock[AGE] < CHECK_PERIOD_S:
        return False
    clock[AGE] = 0.0
    before = clock[VIOLATED] != 0.0
    found = is_beyond(memory, state)
    clock[VIOLATED] = 1.0 if found else 0.0
    return found and not before


@inlined
def is_beyond(memory: SafetyMemory, state: ArmState) -> bool:
    """Tell whether a limit is violated."""
    limits, felt = memory.limits, np.empty(6)
    if limits[TAKES_TORQUES] != 0.0:
        estimate_wrench(felt, memory.observer.torque, state.jacobian, DAMPING)
    else:
        copy_vector(state.wrench, felt)
    if sqrt(felt[0] * felt[0] + felt[1] * felt[1] + felt[2] * felt[2]) > limits[FORCE]:
        return True
    if limits[OBSERVES] != 0.0:
        _, torque = find_unexplained_torque(memory.observer.torque, state.jacobian)
        if torque > limits[TORQUE]:
            return True
    if tool_speed(state.jacobian, state.dq) > limits[SPEED]:
        return True
    if limits[IN_SPACE] == 0.0:
        return False
    return distance_outside(state.tool.position, memory.middle, memory.axes, memory.size) > 0.0


class SafetyMonitor:
    """Describes violated limits of one arm, which `check_limits` finds in `memory`, and what the arm feels.

    The force on the tool is the sensor's, or estimated for an arm that takes torques. Contacts of links are felt by the
    torques of the motors: those that are commanded, or measured ones; of links, where these are measured.
    """

    def __init__(self, limits: SafetyLimits, state: ArmState, mode: Mode, able: Capabilities) -> None:
        self._feels_force, measures_effort = able.feels_force, able.measures_effort
        self._takes_torques = mode == "torque"
        self._measures_effort = measures_effort and (mode != "torque" or able.measures_link_torques)
        observer = MomentumObserver(state)
        self.momentum_observer = observer if self._takes_torques or measures_effort else None
        signals = make_signal_memory(state, able.limits)
        signals.facts[REPEATS], signals.facts[FEELS] = able.never_repeats, able.feels_force
        signals.facts[COMMANDED] = self._takes_torques
        signals.facts[COMPARES] = able.feels_force and self._measures_effort
        self.memory = SafetyMemory(
            np.zeros(8), np.zeros(3), np.eye(3), np.zeros(3), np.zeros(3), observer.memory, signals
        )
        self.limits = limits

    @property
    def limits(self) -> SafetyLimits:
        """The limits."""
        return self._limits

    @limits.setter
    def limits(self, limits: SafetyLimits) -> None:
        self._limits, space, memory = limits, limits.workspace, self.memory
        memory.limits[:] = (
            limits.contact_force_n, limits.collision_torque_n_m, limits.tool_speed_m_s, self._takes_torques,
            self._measures_effort, self.momentum_observer is not None, self._feels_force, space is not None,
        )  # fmt: skip
        memory.signals.facts[MOST_N] = limits.contact_force_n
        if space is not None:
            memory.middle[:], memory.axes[:], memory.size[:] = space.middle.position, space.middle.rotation, space.size

    def add_command(self, command: Command, bias: Array, period: float) -> None:
        """Store the command for the next `period` s, and the bias (nv,) in N m."""
        if self.momentum_observer is not None and isinstance(command, Torque) and not self._measures_effort:
            self.momentum_observer.add_command(command.tau, bias, period)

    def felt_wrench(self, state: ArmState) -> Array | None:
        """Return the wrench (6,) on the tool, N and N m, base axes, by a sensor or by the torques; None if neither is.

        It is never what is commanded. The array is reused.
        """
        if self._feels_force:
            return state.wrench
        return None if self.momentum_observer is None else self.momentum_observer.wrench(state, MEASURING)

    def forget_signals(self) -> None:
        """Compare what is measured from now on with nothing that was measured before."""
        self.memory.signals.numbers[KNOWN] = 0.0

    def describe_signals(self) -> str:
        """Describe what is implausible of the signals."""
        return describe_signals(self.memory.signals)

    def describe(self, state: ArmState) -> str | None:
        """Describe the limit that is violated; None if there is none."""
        limits = self.limits
        observer = self.momentum_observer
        felt = observer.wrench(state) if observer is not None and self._takes_torques else state.wrench
        force = sqrt(felt[0] * felt[0] + felt[1] * felt[1] + felt[2] * felt[2])
        if force > limits.contact_force_n:
            return f"a force of {force:.0f} N on the tool is beyond the {limits.contact_force_n:g} N that the arm bears"
        joint, torque = (0, 0.0) if observer is None else observer.unexplained(state)
        if torque > limits.collision_torque_n_m:
            return (
                f"something is in the way of a link: joint {joint + 1} feels {torque:.0f} N m that no force on the "
                f"tool explains, beyond its {limits.collision_torque_n_m:g} N m"
            )
        speed = tool_speed(state.jacobian, state.dq)
        if speed > limits.tool_speed_m_s:
            return f"the tool moves with {speed:.2f} m/s, beyond the {limits.tool_speed_m_s:g} m/s that the arm may"
        outside = limits.workspace.outside(state.tool.position) if limits.workspace is not None else 0.0
        return f"the tool is {outside * 1e3:.0f} mm outside the arm's workspace" if outside > 0 else None


@compiled
def tool_speed(J: Matrix, dq: Vector) -> float:
    """Return the speed of the tool in m/s. J (6, nv): [linear m; angular rad] per rad, any frame; dq (nv,): rad/s."""
    twist = np.empty(6)
    times(J, dq, twist)
    return sqrt(twist[0] * twist[0] + twist[1] * twist[1] + twist[2] * twist[2])


@compiled
def distance_outside(point: Vector, middle: Vector, axes: Matrix, size: Vector) -> float:
    """Return the distance in m of a point from a box, 0 inside; all in the same frame.

    point: (3,) in m.
    middle: (3,) in m, the centre of the box.
    axes: (3, 3), axes (3, 3) of the box.
    size: (3,) in m, along its axes.
    """
    away, along, square = np.empty(3), np.empty(3), 0.0
    for i in range(3):
        away[i] = point[i] - middle[i]
    transposed_times(axes, away, along)
    for i in range(3):
        outside = max(abs(along[i]) - size[i] / 2, 0.0)
        square += outside * outside
    return sqrt(square)
