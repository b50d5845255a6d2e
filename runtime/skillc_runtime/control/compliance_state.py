"""How an arm yields and pushes at the moment: what skills have set up, and what of it has reached the controller yet.

Everything is along the axes of the compliance frame C, which is fixed in the reference tool frame while an axis is
released; so it turns with the tool when the tool is aligned.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

import numpy as np

from skillc_runtime.control.filters import Lag
from skillc_runtime.control.gains import Gains
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.reference import UNLIMITED_SPEED, Compliance

PARALLEL = 0.99
"""Cosine above which two directions count as one: about 8 degrees."""

ACROSS = (1 - PARALLEL**2) ** 0.5
"""Cosine below which two directions count as at right angles."""

RELEASED_FIRST = 2
"""The axis of C that is released first."""


@dataclass(frozen=True, slots=True)
class ComplianceSetpoint:
    """What skills want, along the axes of the compliance frame C.

    stiffness (6,): N/m and N m/rad; force (3,): N that the tool exerts; frame (3, 3): C's axes in the tool frame;
    fastest (3,): m/s, how fast the tool may go that way, as in `Compliance`.
    """

    stiffness: Array
    force: Array
    frame: Array
    fastest: Array


class ComplianceState:
    """The wanted setpoints, innermost last; `applied` follows them with the gains' command time."""

    def __init__(self, gains: Gains) -> None:
        stiffness = np.repeat([gains.linear_stiffness, gains.rotational_stiffness], 3)
        self._unasked = stiffness.copy()
        self._setpoints = [ComplianceSetpoint(stiffness, np.zeros(3), np.eye(3), UNLIMITED_SPEED)]
        self._stiffness = Lag(stiffness, gains.command_time, grain=1e-2)
        self._wrench = Lag(np.zeros(6), gains.command_time, grain=1e-3)
        self._target, self._arrived_at = np.zeros(6), self.wanted
        self._ratio = gains.damping_ratio
        self.applied = self._compliance()

    @property
    def wanted(self) -> ComplianceSetpoint:
        """The innermost setpoint."""
        return self._setpoints[-1]

    @property
    def released(self) -> bool:
        """Tell whether some skill has released an axis."""
        return len(self._setpoints) > 1

    @property
    def stiff(self) -> bool:
        """Tell whether skills want the arm to hold its tool as it does unasked."""
        return not self.released and bool((self.wanted.stiffness == self._unasked).all())

    @property
    def pushing(self) -> bool:
        """Tell whether the tool pushes, or what it pushed with has not faded yet."""
        return self._arrived_at is not self.wanted or bool(self.wanted.force.any())

    def step(self, period: float) -> Compliance:
        """Let stiffness and wrench follow for `period` s; the arrays of the result are reused."""
        wanted = self._setpoints[-1]
        if wanted is not self._arrived_at:
            self._target[:3] = wanted.force
            self._stiffness.step(wanted.stiffness, period)
            self._wrench.step(self._target, period)
            if self._stiffness.arrived and self._wrench.arrived:
                self._arrived_at = wanted
        return self.applied

    def release(self, direction: Array, stiffness: float) -> None:
        """Let the tool yield along a unit direction (3,) of the tool frame. ValueError for one askew to another."""
        frame = self._frame_for(direction)
        axis = _axis(frame, direction)
        wanted = self.wanted.stiffness.copy()
        wanted[axis] = stiffness
        self._wrench.value[:3] = frame.T @ self.wanted.frame @ self._wrench.value[:3]
        self._setpoints.append(replace(self.wanted, stiffness=wanted, frame=frame))
        self.applied = self._compliance()

    def restore(self, error: Array) -> None:
        """Undo the last release; C stays until the next one.

        error (3,): tool minus reference along C's axes, which the caller is about to take as nothing on the axes that
        regain stiffness; the force that their springs exert is kept as a push and fades.
        """
        before = self._setpoints.pop()
        back = self.wanted.stiffness[:3] != before.stiffness[:3]
        self._wrench.value[:3] -= back * self._stiffness.value[:3] * error
        kept = before if self.released else replace(self.wanted, frame=before.frame)
        self._push_as(replace(kept, stiffness=self.wanted.stiffness))

    def regained_axes(self) -> Array:
        """Return, of C's axes in the tool frame, those that `restore` would make stiff again (3, n)."""
        before, after = self._setpoints[-1], self._setpoints[-2]
        return before.frame[:, before.stiffness[:3] != after.stiffness[:3]]

    def push(self, direction: Array, force_n: float, fastest_m_s: float = inf) -> None:
        """Press along a unit direction (3,) of the tool frame, and go no faster that way, whoever pushes besides.

        ValueError where the tool does not yield along it.
        """
        axis = _axis(self.wanted.frame, direction)
        if not self.yields(direction):
            raise ValueError("the arm does not yield along the direction in which it shall push")
        force, fastest, sign = np.zeros(3), UNLIMITED_SPEED.copy(), np.sign(self.wanted.frame[:, axis] @ direction)
        force[axis], fastest[axis] = sign * force_n, sign * fastest_m_s
        self._push_as(replace(self.wanted, force=force, fastest=fastest))

    def push_off(self) -> None:
        """Stop pushing."""
        self._push_as(replace(self.wanted, force=np.zeros(3), fastest=UNLIMITED_SPEED))

    def yields(self, direction: Array) -> bool:
        """Tell whether the tool yields along a direction (3,) of the tool frame."""
        cosines = np.abs(self.wanted.frame.T @ direction)
        axis = int(cosines.argmax())
        return bool(cosines[axis] > PARALLEL and self.wanted.stiffness[axis] != self._setpoints[0].stiffness[axis])

    def set_rotation_free(self, free: bool) -> None:
        """Release, or restore, the two rotations about C's x and y."""
        stiffness = self.wanted.stiffness.copy()
        stiffness[3:5] = 0.0 if free else self._setpoints[0].stiffness[3:5]
        self._setpoints[-1] = replace(self.wanted, stiffness=stiffness)

    def _push_as(self, setpoint: ComplianceSetpoint) -> None:
        """Take another push for the innermost setpoint."""
        self._setpoints[-1] = setpoint
        self.applied = self._compliance()

    def _frame_for(self, direction: Array) -> Array:
        """Return axes (3, 3) of which one is the direction, if there may be any.

        As long as one axis alone is released, the two others are alike and may turn about it.
        """
        if not self.released:
            return _frame_along(direction)
        frame = self.wanted.frame
        alone = len(self._setpoints) == 2 and abs(float(frame[:, RELEASED_FIRST] @ direction)) < ACROSS
        return _turned(frame, direction) if alone else frame

    def _compliance(self) -> Compliance:
        frame, fastest = self.wanted.frame, self.wanted.fastest
        return Compliance(self._stiffness.value, self._wrench.value, frame, self._ratio, fastest)


def _frame_along(direction: Array) -> Array:
    """Return axes (3, 3) whose z is the direction and whose x is as near to the tool's x as it can be."""
    near = np.eye(3)[0] if abs(direction[0]) < 0.9 else np.eye(3)[1]
    x = near - direction * (near @ direction)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(direction, x), direction])


def _turned(frame: Array, direction: Array) -> Array:
    """Return the frame turned about its z so that its x is along a direction (3,) at right angles to that."""
    z = frame[:, RELEASED_FIRST]
    x = direction - z * (z @ direction)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def _axis(frame: Array, direction: Array) -> int:
    """Return which of the frame's axes a direction is parallel to."""
    cosines = np.abs(frame.T @ direction)
    axis = int(cosines.argmax())
    if cosines[axis] < PARALLEL:
        raise ValueError("the direction must be parallel or at right angles to the one released before")
    return axis
