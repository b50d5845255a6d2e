"""Whether friction between fingers and an object can carry the load on it: the force between hand and object.

Coulomb: two sides that press with F each carry 2 mu F along them. Forces normal to the fingers are always carried,
since grippers do not yield, and moments too, since real pads are wider than simulated ones.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from skillc_runtime.backends.simulation.steps import Due, is_due
from skillc_runtime.motion.numerics.compiled import Bound, bind
from skillc_runtime.motion.pose import Array

CHECK_PERIOD_S = 0.01
"""Period with which the load is checked."""

OVERLOAD_S = 0.03
"""A shorter overload is an impact, in which an object slips by less than the uncertainty of its grasp."""

SIDES = 2


@dataclass
class Grip:
    """A grasp: the direction (3,) in which fingers press, in the palm's axes, each with `force_n`.

    `bears_n` is the friction across it.

    overloaded_from: s, start of the present overload; due (1,): s, of the next check.
    """

    pressing: Array
    force_n: float
    bears_n: float
    overloaded_from: float = np.inf
    due: Array = field(default_factory=lambda: np.zeros(1))

    @cached_property
    def is_due(self) -> Bound[[float], int]:
        """Tells, with the beginning of a step in s, whether the load has to be checked."""
        return bind(is_due, Due(self.due))

    def is_overloaded(self, now: float, palm: Array, pull: Callable[[], Array]) -> bool:
        """Tell whether the load has exceeded the grip for `OVERLOAD_S`.

        palm (3, 3): its axes in the world; `pull` returns the force (3,) in N between hand and object, in the world.
        To be called in each step, between `mj_step2` and the next `mj_step1`.
        """
        if now < self.due[0]:
            return False
        force, pressing = pull(), palm @ self.pressing
        self.due[0], across = now + CHECK_PERIOD_S, float(np.linalg.norm(force - force @ pressing * pressing))
        self.overloaded_from = min(self.overloaded_from, now) if across > self.bears_n else np.inf
        return now - self.overloaded_from >= OVERLOAD_S


def make_grip(palm: Array, normals: list[Array], friction: float, force_n: float) -> Grip:
    """Return the grip of fingers that press with `force_n` each along normals (3,) in the world; palm: its axes."""
    return Grip(palm.T @ normals[0], force_n, SIDES * friction * force_n)
