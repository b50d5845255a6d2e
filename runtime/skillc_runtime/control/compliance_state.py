"""The compliance of an arm: the setpoints of skills, and the values that the controller uses, which follow them.

All values are along the axes of the compliance frame C, which is fixed in the reference tool frame while an axis is
released, so it rotates with the tool.
"""

from __future__ import annotations

from math import inf

import msgspec
import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from skillc_runtime.control.filters import lag_share, step_lag
from skillc_runtime.control.gains import Gains
from skillc_runtime.motion.arrays import OutMatrix, OutVector
from skillc_runtime.motion.numerics.compiled import bind, compiled, inlined
from skillc_runtime.motion.numerics.linear import times
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.reference import UNLIMITED_SPEED, Compliance

PARALLEL = 0.99
"""Cosine above which two directions count as parallel: about 8 degrees."""

ACROSS = (1 - PARALLEL**2) ** 0.5
"""Cosine below which two directions count as perpendicular."""

RELEASED_FIRST = 2
"""The axis of C along which the first release is."""


class ComplianceSetpoint(msgspec.Struct, frozen=True):
    """The compliance that skills command, along the axes of the compliance frame C.

    stiffness (6,): N/m and N m/rad; force (3,): N that the tool exerts; frame (3, 3): axes of C in the tool frame;
    fastest (3,): m/s, the greatest speed, as in `Compliance`.
    """

    stiffness: Array
    force: Array
    frame: Array
    fastest: Array


STIFFNESS, WRENCH = 0, 1
"""Rows of `ComplianceMemory.target`."""

STIFFNESS_GRAIN, WRENCH_GRAIN = 1e-2, 1e-3
"""Closer to their targets than this, N/m and N m/rad, or N and N m, stiffness and wrench have arrived."""


class ComplianceMemory(msgspec.Struct, frozen=True):
    """What a law uses, as in `Compliance`, and what that follows, with a time constant of command_time s.

    exerted (3,): N, along the axes of the reference tool frame; target (2, 6): stiffness and wrench; follows (1,): 0 if
    they have arrived.
    """

    stiffness: OutVector
    wrench: OutVector
    frame: OutMatrix
    damping_ratio: float
    fastest: OutVector
    exerted: OutVector
    target: OutMatrix
    follows: OutVector
    command_time: float


@inlined
def follow_target(memory: ComplianceMemory, period: float) -> None:
    """Let stiffness and wrench follow their targets for `period` s."""
    if memory.follows[0] == 0.0:
        return
    share = lag_share(period, memory.command_time)
    stiff = step_lag(memory.stiffness, memory.target[STIFFNESS], share, STIFFNESS_GRAIN)
    pushes = step_lag(memory.wrench, memory.target[WRENCH], share, WRENCH_GRAIN)
    times(memory.frame, memory.wrench[:3], memory.exerted)
    if stiff and pushes:
        memory.follows[0] = 0.0


@compiled
def step_compliance(memory: ComplianceMemory, period: float) -> None:
    """Let stiffness and wrench follow their targets for `period` s."""
    follow_target(memory, period)


class ComplianceState:
    """The nested setpoints, innermost last; `applied` follows them with the command time of the gains.

    While `held`, released axes have the stiffness of the gains and the tool does not push, whatever the setpoints are.
    Stiffness (6,) in N/m and N m/rad, force (3,) in N, directions (3,) are unit vectors; stiffness of a release in N/m.
    `step` lets stiffness and wrench follow for a period in s; the arrays of `applied`, in `memory`, change.
    `exerted` (3,) is the applied force along the axes of the reference tool frame, in N; one array, which changes.
    """

    def __init__(self, gains: Gains) -> None:
        stiffness = np.repeat([gains.linear_stiffness, gains.rotational_stiffness], 3)
        self._unasked = stiffness.copy()
        self._setpoints = [ComplianceSetpoint(stiffness, np.zeros(3), np.eye(3), UNLIMITED_SPEED)]
        self.held, self.exerted = False, np.zeros(3)
        self.memory = ComplianceMemory(
            stiffness.copy(), np.zeros(6), np.eye(3), gains.damping_ratio, UNLIMITED_SPEED.copy(), self.exerted,
            np.array([stiffness, np.zeros(6)]), np.zeros(1), gains.command_time,
        )  # fmt: skip
        self.step = bind(step_compliance, self.memory)
        self._followed, memory = self.wanted, self.memory
        self.applied = Compliance(memory.stiffness, memory.wrench, memory.frame, memory.damping_ratio, memory.fastest)

    @property
    def wanted(self) -> ComplianceSetpoint:
        """The innermost setpoint."""
        return self._setpoints[-1]

    @property
    def released(self) -> bool:
        """Whether an axis is released."""
        return len(self._setpoints) > 1

    @property
    def stiff(self) -> bool:
        """Whether the setpoint has the stiffness of the gains along all axes."""
        return not self.released and bool((self.wanted.stiffness == self._unasked).all())

    @property
    def pushing(self) -> bool:
        """Whether the tool pushes, or its last push has not faded out yet."""
        return bool(self.memory.follows[0]) or bool(self._followed.force.any())

    def release(self, direction: Array, stiffness: float) -> None:
        """Release a direction (3,) of the tool frame; ValueError if it is oblique to an earlier one."""
        frame = self._frame_for(direction)
        axis = _axis(frame, direction)
        wanted = self.wanted.stiffness.copy()
        wanted[axis] = stiffness
        self.memory.wrench[:3] = frame.T @ self.wanted.frame @ self.memory.wrench[:3]
        self._setpoints.append(replace(self.wanted, stiffness=wanted, frame=frame))
        self._follow()

    def restore(self, error: Array) -> None:
        """Undo the last release; C is kept until the next one.

        error (3,): tool minus reference in m along the axes of C. The caller sets it to zero on the axes that regain
        stiffness; the force of their springs is kept as a push, which fades out.
        """
        before = self._setpoints.pop()
        back = self.wanted.stiffness[:3] != before.stiffness[:3]
        self.memory.wrench[:3] -= back * self.memory.stiffness[:3] * error
        kept = before if self.released else replace(self.wanted, frame=before.frame)
        self.held = self.held and self.released
        self._replace(replace(kept, stiffness=self.wanted.stiffness))

    def regained_axes(self) -> Array:
        """Return the axes (3, n) of C, in the tool frame, that `restore` would make stiff again."""
        before, after = self._setpoints[-1], self._setpoints[-2]
        return before.frame[:, before.stiffness[:3] != after.stiffness[:3]]

    def push(self, direction: Array, force_n: float, fastest_m_s: float = inf) -> None:
        """Push along a direction, and limit the speed of the tool in it.

        Raises ValueError if the direction is not released.
        direction: (3,), a unit vector in the tool frame.
        force_n: N.
        fastest_m_s: m/s.
        """
        axis = _axis(self.wanted.frame, direction)
        if not self.yields(direction):
            raise ValueError("the arm does not yield along the direction in which it shall push")
        force, fastest, sign = np.zeros(3), UNLIMITED_SPEED.copy(), np.sign(self.wanted.frame[:, axis] @ direction)
        force[axis], fastest[axis] = sign * force_n, sign * fastest_m_s
        self._replace(replace(self.wanted, force=force, fastest=fastest))

    def push_off(self) -> None:
        """Stop pushing."""
        self._replace(replace(self.wanted, force=np.zeros(3), fastest=UNLIMITED_SPEED))

    def yields(self, direction: Array) -> bool:
        """Tell whether a direction (3,) of the tool frame is released."""
        cosines = np.abs(self.wanted.frame.T @ direction)
        axis = int(cosines.argmax())
        return bool(cosines[axis] > PARALLEL and self.wanted.stiffness[axis] != self._setpoints[0].stiffness[axis])

    def set_rotation_free(self, free: bool) -> None:
        """Release, or restore, the rotations about x and y of C."""
        stiffness = self.wanted.stiffness.copy()
        stiffness[3:5] = 0.0 if free else self._setpoints[0].stiffness[3:5]
        self._replace(replace(self.wanted, stiffness=stiffness))

    def hold(self, error: Array) -> None:
        """Make axes with less than the stiffness of the gains stiff, and stop pushing, until `let_go`; no rotations.

        error (3,): tool minus reference in m along the axes of C. The caller sets it to zero on the axes that regain
        stiffness.
        """
        self.memory.wrench[:3] -= self._yields() * self.memory.stiffness[:3] * error
        self.held = True
        self._follow()

    def let_go(self) -> None:
        """Follow the setpoints again after `hold`."""
        self.held = False
        self._follow()

    def released_axes(self) -> Array:
        """Return the axes (3, n) of C, in the tool frame, that have less than the stiffness of the gains."""
        return self.wanted.frame[:, self._yields()]

    def _yields(self) -> NDArray[np.bool_]:
        """Return which axes (3,) of C have less than the stiffness of the gains."""
        less: NDArray[np.bool_] = self.wanted.stiffness[:3] < self._unasked[:3]
        return less

    def _replace(self, setpoint: ComplianceSetpoint) -> None:
        """Replace the innermost setpoint, at once."""
        self._setpoints[-1] = setpoint
        self._follow()

    def _follow(self) -> None:
        """Follow the innermost setpoint; while held, with stiffness and without a push."""
        wanted = self.wanted
        if self.held:
            stiffness = wanted.stiffness.copy()
            stiffness[:3] = np.maximum(stiffness[:3], self._unasked[:3])
            wanted = ComplianceSetpoint(stiffness, np.zeros(3), wanted.frame, UNLIMITED_SPEED)
        self._followed, memory = wanted, self.memory
        memory.frame[:], memory.fastest[:] = wanted.frame, wanted.fastest
        memory.target[STIFFNESS], memory.target[WRENCH, :3] = wanted.stiffness, wanted.force
        memory.follows[0] = 1.0
        memory.frame.dot(memory.wrench[:3], out=self.exerted)

    def _frame_for(self, direction: Array) -> Array:
        """Return axes (3, 3) of which one is the direction, if possible.

        While only one axis is released, the other two have the same stiffness and may rotate about it.
        """
        if not self.released:
            return _frame_along(direction)
        frame = self.wanted.frame
        alone = len(self._setpoints) == 2 and abs(float(frame[:, RELEASED_FIRST] @ direction)) < ACROSS
        return _turned(frame, direction) if alone else frame


def _frame_along(direction: Array) -> Array:
    """Return axes (3, 3) whose z is the direction and whose x is as close as possible to the tool's x."""
    near = np.eye(3)[0] if abs(direction[0]) < 0.9 else np.eye(3)[1]
    x = near - direction * (near @ direction)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(direction, x), direction])


def _turned(frame: Array, direction: Array) -> Array:
    """Return the frame rotated about its z so that its x is along a direction (3,) perpendicular to z."""
    z = frame[:, RELEASED_FIRST]
    x = direction - z * (z @ direction)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def _axis(frame: Array, direction: Array) -> int:
    """Return the index of the axis that a direction is parallel to; ValueError if there is none."""
    cosines = np.abs(frame.T @ direction)
    axis = int(cosines.argmax())
    if cosines[axis] < PARALLEL:
        raise ValueError("the direction must be parallel or at right angles to the one released before")
    return axis
