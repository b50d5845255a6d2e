"""Whether friction between fingers and a thing bears what pulls at it, which the weld that keeps the thing measures.

Coulomb: two sides that press with F each bear 2 mu F along them. They bear what presses on the fingers however
strong it is, since grippers do not give way, and moments, since real pads are wider than simulated ones.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array

CHECK_PERIOD_S = 0.01
"""How often the pull is looked at."""

OVERLOAD_S = 0.03
"""A shorter overload is a jolt, in which a thing creeps by less than it is grasped off its middle."""

SIDES = 2


@dataclass(slots=True)
class Grip:
    """A grasp: the direction (3,) in which fingers press, in the palm's axes, and how much friction bears across it, N.

    `equality` is the weld, `palm` the body it ends at. All is well until `overloaded_from`; the pull is looked at again
    at `next_look`, both in s.
    """

    equality: int
    palm: int
    pressing: Array
    bears_n: float
    overloaded_from: float = np.inf
    next_look: float = 0.0

    def overload(self, data: Any, now: float) -> float | None:
        """Return the pull in N that the grip has not borne for a while, None while it holds.

        To be called each step, between `mj_step2` and the next `mj_step1`.
        """
        if now < self.next_look:
            return None
        self.next_look, pull = now + CHECK_PERIOD_S, self._pull(data)
        self.overloaded_from = min(self.overloaded_from, now) if pull > self.bears_n else np.inf
        return pull if now - self.overloaded_from >= OVERLOAD_S else None

    def _pull(self, data: Any) -> float:
        """Return the force across the pressing direction that the weld bears; none before it first acts."""
        kinds, owners = data.efc_type[: data.ne], data.efc_id[: data.ne]
        rows = np.flatnonzero((kinds == mujoco.mjtConstraint.mjCNSTR_EQUALITY) & (owners == self.equality))
        force = data.efc_force[rows[:3]]
        if force.size == 0:
            return 0.0
        pressing = data.xmat[self.palm].reshape(3, 3) @ self.pressing
        return float(np.linalg.norm(force - force @ pressing * pressing))


def make_grip(data: Any, equality: int, palm: int, normals: list[Array], friction: float, force_n: float) -> Grip:
    """Return the grip of fingers that press with so much force each along normals (3,) of the world."""
    pressing = data.xmat[palm].reshape(3, 3).T @ normals[0]
    return Grip(equality, palm, pressing, SIDES * friction * force_n)
