"""A passivity observer and controller: an admittance gives its surroundings no energy that it was not given.

A wrench w moves a tool that yields: what it feels, its push, and its springs. An ideal admittance A moves it with
v = A w along each axis, relative to its reference, so that w v is never negative. The delay of commands, the lag of
servos and what bends between motors and tool let it move later, and beyond some frequency it feeds an oscillation: then
w v is negative in the mean. So a tank with the capacity E_max, more than a tool gives back when it is stopped, has the
level

    E' = sum_i w_i v_i,   E <= E_max

by what is measured of the motion. While it falls below zero, the share s of all A that is used falls, s' = -s / T_s,
which is damping 1 / (s A) that rises. Once the tank is filled again s rises, with T_r, but only to 0.4 times what it
was when it began to fall, until the push ends: so it falls some times, and no oscillation comes back for ever. Beside
the push, where less of A lets a tool fall behind its path, min(s / 0.4, 1) is used: less than 1 only from the second
fall on, once s has risen. J.-H. Ryu, D.-S. Kwon, B. Hannaford: Stable Teleoperation with Time-Domain Passivity Control,
IEEE Transactions on Robotics and Automation 20(2), 2004; the tank as in F. Ferraguti, C. Secchi, C. Fantuzzi: A Tank-
Based Approach to Impedance Control with Variable Stiffness, ICRA 2013.
"""

from __future__ import annotations

from math import exp
from typing import Final

import numpy as np

from skillc_runtime.motion.arrays import OutVector, Vector
from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.pose import Array

CAPACITY_J: Final = 0.004
"""The level E_max. A swing of 20 ms with 10 N and 20 mm/s has 4 mJ."""

FALLING_S, RISING_S = 0.01, 0.2
"""The times T_s and T_r."""

KEPT: Final = 0.4
"""The share of what s was that it comes back to, and of its capacity that the tank must have for that."""

LEAST_SHARE: Final = 0.02
"""The tool yields at least by this share of its admittance."""

LEVEL, SHARE, MOST, FALLS = range(4)
"""Entries of the tank: J; the share s, and to what it may rise; 1 from when it falls until it may rise."""


def make_tank() -> Array:
    """Return the full tank, (4,) in N m and shares, see `LEVEL`, of a push in any frame."""
    return np.array([CAPACITY_J, 1.0, 1.0, 0.0])


@inlined
def fill_tank(tank: OutVector) -> None:
    """Fill a tank (4,) in N m and shares, see `LEVEL`, of an arm that pushes nothing, in any frame."""
    tank[LEVEL], tank[SHARE], tank[MOST], tank[FALLS] = CAPACITY_J, 1.0, 1.0, 0.0


@inlined
def watch_energy(tank: OutVector, wrench: Vector, velocity: Vector, period: float) -> float:
    """Let the level of a tank follow a period; return the share s to use.

    tank: (4,) in N m and shares, see `LEVEL`; it is changed.
    wrench: (n,) in N and N m, w, along n axes of the compliance frame.
    velocity: (n,) in m/s and rad/s, v along these, as it was measured, relative to the reference.
    period: s.
    """
    power, share = 0.0, tank[SHARE]
    for i in range(velocity.size):
        power += velocity[i] * wrench[i]
    level = min(tank[LEVEL] + power * period, CAPACITY_J)
    tank[LEVEL] = level
    if level < 0.0 and power < 0.0:
        if tank[FALLS] == 0.0:
            tank[FALLS], tank[MOST] = 1.0, max(KEPT * share, LEAST_SHARE)
        tank[SHARE] = max(share * exp(-period / FALLING_S), LEAST_SHARE)
    elif level >= KEPT * CAPACITY_J or tank[FALLS] == 0.0:
        tank[FALLS] = 0.0
        tank[SHARE] += (tank[MOST] - share) * (1.0 - exp(-period / RISING_S))
    used: float = tank[SHARE]
    return used
