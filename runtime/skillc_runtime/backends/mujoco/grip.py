"""Whether friction between fingers and an object can carry the load on it: the force between hand and object.

Coulomb: two sides that press with F each carry 2 mu F along them. Forces normal to the fingers are always carried,
since grippers do not yield, and moments too, since real pads are wider than simulated ones.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from math import inf, sqrt

import msgspec
import numpy as np

from skillc_runtime.backends.mujoco.mirror import Pull, measure_pull
from skillc_runtime.backends.simulation.steps import Due, is_due
from skillc_runtime.motion.arrays import Matrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import Bound, bind, compiled, inlined
from skillc_runtime.motion.numerics.linear import times
from skillc_runtime.motion.pose import Array

CHECK_PERIOD_S = 0.01
"""Period with which the load is checked."""

OVERLOAD_S = 0.03
"""A shorter overload is an impact, in which an object slips by less than the uncertainty of its grasp."""

SIDES = 2

IS_DUE, SLIPS = 1, 2
"""Bits of what looking at a load asks for: the force has to be measured; the grip does not bear it."""

DUE, SINCE = 0, 1
"""Entries of `Grip.times`, s: of the next check; the start of the present overload, or infinity."""


class Load(msgspec.Struct, frozen=True):
    """The load on a grasp: force (3,), N, between hand and object, in the world; others: see `Grip`.

    palm (3, 3): its axes in the world.
    """

    force: Vector
    palm: Matrix
    pressing: Vector
    bears_n: float
    times: OutVector


@inlined
def is_overloaded(load: Load, now: float) -> bool:
    """Tell whether the load has exceeded the grip for `OVERLOAD_S`; the next check is due a period later."""
    force, pressing, along, square = load.force, np.empty(3), 0.0, 0.0
    times(load.palm, load.pressing, pressing)
    for i in range(3):
        along += force[i] * pressing[i]
    for i in range(3):
        square += (force[i] - along * pressing[i]) ** 2
    load.times[DUE] = now + CHECK_PERIOD_S
    load.times[SINCE] = min(load.times[SINCE], now) if sqrt(square) > load.bears_n else inf
    return bool(now - load.times[SINCE] >= OVERLOAD_S)


@compiled
def check_load(load: Load, now: float) -> int:
    """Return `SLIPS` if a load whose force was measured has exceeded the grip."""
    return SLIPS if is_overloaded(load, now) else 0


class PulledLoad(msgspec.Struct, frozen=True):
    """A load whose force is a pull."""

    load: Load
    pull: Pull


@compiled
def watch_load(watched: PulledLoad, now: float) -> int:
    """Measure the load if it is due; return `SLIPS` if it has exceeded the grip."""
    if now < watched.load.times[DUE]:
        return 0
    measure_pull(watched.pull)
    return SLIPS if is_overloaded(watched.load, now) else 0


@dataclass
class Grip:
    """A grasp: the direction (3,) in which fingers press, in the palm's axes, each with `force_n`.

    `bears_n` is the friction across it. times (2,): see above.
    """

    pressing: Array
    force_n: float
    bears_n: float
    times: Array = field(default_factory=lambda: np.array([0.0, np.inf]))
    _watched: tuple[Pull, Bound[[float], int]] | None = None

    @cached_property
    def is_due(self) -> Bound[[float], int]:
        """Tells, with the beginning of a step in s, whether the load has to be checked."""
        return bind(is_due, Due(self.times[:1]))

    def watch(self, palm: Array, pull: Pull) -> Bound[[float], int]:
        """Return what tells of each step, after `mj_step2` and before the next `mj_step1`, whether a pull is too much.

        palm (3, 3): its axes in the world, an array that changes.
        """
        if self._watched is None or self._watched[0] is not pull:
            self._watched = pull, bind(watch_load, PulledLoad(self._load(palm, pull.force), pull))
        return self._watched[1]

    def slips(self, now: float, palm: Array, force: Array) -> bool:
        """Tell whether a load has exceeded the grip, once it is due; palm (3, 3) and force (3,) in N as in `Load`."""
        return check_load(self._load(palm, force), now) != 0

    def _load(self, palm: Array, force: Array) -> Load:
        return Load(force, palm, self.pressing, self.bears_n, self.times)


def make_grip(palm: Array, normals: list[Array], friction: float, force_n: float) -> Grip:
    """Return the grip of fingers that press with `force_n` each along normals (3,) in the world; palm: its axes."""
    return Grip(palm.T @ normals[0], force_n, SIDES * friction * force_n)
