"""How the controller moves its targets: hold, `servoj`, `speedj`, a stop, `force_mode`.

Universal Robots publishes neither the filter of `servoj` nor the gains of `force_mode`: here targets follow as a
critically damped second-order system with w = 2 / lookahead * sqrt(gain / 300), so that a gain of 300 is late by the
look-ahead time; and force mode moves at 10 mm/s for each N that is missing.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import sqrt
from typing import TypeAlias, assert_never

import numpy as np

from robots.ur.emulator.limits import JOINT_SPEED
from robots.ur.emulator.plant import STEP_S, Plant
from skillc_runtime.motion.pose import Array

FORCE_GAIN = 0.01
"""m/(s N): how fast force mode moves for the force that is missing."""


@dataclass
class Hold:
    """Stand still."""


@dataclass
class Servo:
    """Follow q (6,) in rad with a look-ahead time in s and a gain."""

    q: Array
    lookahead_s: float
    gain: float


@dataclass
class Speed:
    """Reach joint speeds (6,) in rad/s with an acceleration in rad/s^2."""

    dq: Array
    acceleration: float


@dataclass
class Stop:
    """Come to rest with a deceleration in rad/s^2."""

    deceleration: float


@dataclass
class Force:
    """Push with a wrench (6,) in base axes along the axes that are selected (6,), at most at speeds (6,)."""

    selected: Array
    wrench: Array
    limits: Array


Job: TypeAlias = Hold | Servo | Speed | Stop | Force


@dataclass
class Motion:
    """The targets of the joints: q, dq (6,) in rad and rad/s, and the job that moves them."""

    q: Array
    dq: Array = field(default_factory=lambda: np.zeros(6))
    job: Job = field(default_factory=Hold)

    def advance(self, plant: Plant, wrench: Array, share: float) -> None:
        """Move the targets, and let the plant follow; wrench (6,): on the tool in base axes; share: of the speed."""
        match self.job:
            case Hold():
                self.dq[:] = 0.0
            case Servo(q=goal, lookahead_s=lookahead, gain=gain):
                w = 2.0 / lookahead * sqrt(gain / 300.0)
                wanted = self.dq + STEP_S * (w * w * (goal - self.q) - 2.0 * w * self.dq)
                self._move_at(np.clip(wanted, -share * JOINT_SPEED, share * JOINT_SPEED))
            case Speed(dq=goal, acceleration=most):
                self._move_at(self.dq + np.clip(share * goal - self.dq, -most * STEP_S, most * STEP_S))
            case Stop(deceleration=most):
                self._move_at(self.dq - np.clip(self.dq, -most * STEP_S, most * STEP_S))
            case Force(selected=selected, wrench=goal, limits=limits):
                speed = selected * np.clip(FORCE_GAIN * (goal + wrench), -limits, limits)
                jacobian = plant.body.state().jacobian
                self._move_at(share * np.linalg.solve(jacobian.T @ jacobian + 1e-4 * np.eye(6), jacobian.T @ speed))
            case _:
                assert_never(self.job)
        plant.servo_to(self.q)

    def _move_at(self, dq: Array) -> None:
        self.dq = dq
        self.q = self.q + STEP_S * dq
