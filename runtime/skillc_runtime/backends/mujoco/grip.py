"""Whether friction between fingers and an object can carry the load on it, which is measured at its weld.

Coulomb: two sides that press with F each carry 2 mu F along them. Forces normal to the fingers are always carried,
since grippers do not yield, and moments too, since real pads are wider than simulated ones.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from skillc_runtime.motion.pose import Array

CHECK_PERIOD_S = 0.01
"""Period with which the load is checked."""

OVERLOAD_S = 0.03
"""A shorter overload is an impact, in which an object slips by less than the uncertainty of its grasp."""

SIDES = 2


@dataclass(slots=True)
class Grip:
    """A grasp: the direction (3,) in which fingers press, in the palm's axes, each with `force_n`.

    `bears_n` is the friction across it.

    equality: the weld; palm: its body; overloaded_from: s, start of the present overload; next_check: s, of the next
    check.
    """

    equality: int
    palm: int
    pressing: Array
    force_n: float
    bears_n: float
    overloaded_from: float = np.inf
    next_check: float = 0.0

    def is_overloaded(self, data: Any, now: float) -> bool:
        """Tell whether the load has exceeded the grip for `OVERLOAD_S`.

        To be called in each step, between `mj_step2` and the next `mj_step1`.
        """
        if now < self.next_check:
            return False
        self.next_check, pull = now + CHECK_PERIOD_S, self._load(data)
        self.overloaded_from = min(self.overloaded_from, now) if pull > self.bears_n else np.inf
        return now - self.overloaded_from >= OVERLOAD_S

    def _load(self, data: Any) -> float:
        """Return the force of the weld in N across the pressing direction; 0 before it acts."""
        owners = data.efc_id[: data.ne].tolist()  # the rows of equality constraints come before all others
        if self.equality not in owners:
            return 0.0
        first = owners.index(self.equality)
        force = data.efc_force[first : first + 3]
        pressing = data.xmat[self.palm].reshape(3, 3) @ self.pressing
        return float(np.linalg.norm(force - force @ pressing * pressing))


def make_grip(data: Any, equality: int, palm: int, normals: list[Array], friction: float, force_n: float) -> Grip:
    """Return the grip of fingers that press with `force_n` each along normals (3,) in the world."""
    pressing = data.xmat[palm].reshape(3, 3).T @ normals[0]
    return Grip(equality, palm, pressing, force_n, SIDES * friction * force_n)
