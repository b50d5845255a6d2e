"""The stiffness of what a tool touches, identified while it approaches, and the admittance that this allows.

Pushed with the speed v against something of stiffness K, the force on the tool changes by df = -K v h in a period h.
Sums that forget with the time T give K = -sum(dx df) / sum(dx^2), dx = v h, while the tool moves about as fast as it
approaches, either way; what was found last counts until the push ends. The force loop of an admittance A with the lag
T_v has the gain A K. With the delay d of commands, from A K (T_v + 2 d) = GREATEST_GAIN on the admittance is A K_0 / K,
K_0 = GREATEST_GAIN / (A (T_v + 2 d)), so that the loop is not faster at a stiff contact than at that. That the
admittance has to be less as the environment is stiffer: N. Hogan, Impedance Control: An Approach to Manipulation,
Journal of Dynamic Systems, Measurement, and Control 107(1), 1985.
"""

from __future__ import annotations

from math import exp
from typing import Final

from skillc_runtime.motion.arrays import OutVector
from skillc_runtime.motion.numerics.compiled import inlined

GREATEST_GAIN: Final = 3.0
"""The greatest A K (T_v + 2 d); without delay the loop is damped with 1 / (2 sqrt(3)) = 0.29 then."""

FORGETTING_S: Final = 0.005
"""The time T."""

APPROACHING: Final = 0.6
"""Share of its approach speed from which on a tool moves as fast as it approaches."""

SQUARES, PRODUCTS, FORCE, STIFFNESS = range(4)
"""Entries of the memory: sum(dx^2) in m^2, -sum(dx df) in N m, the last force in N, the stiffness in N/m."""


def stiffest_contact(admittance: float, lag_s: float, delay_s: float) -> float:
    """Return K_0 in N/m.

    admittance: m/(s N), of the tool.
    lag_s: s, the lag T_v of the admittance.
    delay_s: s, the delay d of commands.
    """
    return GREATEST_GAIN / (admittance * (lag_s + 2.0 * delay_s))


@inlined
def identify_stiffness(memory: OutVector, speed: float, force: float, approach: float, period: float) -> None:
    """Let the stiffness follow from a period; speed and force are along the same axis, in any frame.

    memory: (4,) in m^2, N m, N and N/m, see `SQUARES`; it is changed.
    speed: m/s, as it is.
    force: N.
    approach: m/s, as it is wanted.
    period: s.
    """
    keep, way = exp(-period / FORGETTING_S), speed * period
    memory[SQUARES] = keep * memory[SQUARES] + way * way
    memory[PRODUCTS] = keep * memory[PRODUCTS] - way * (force - memory[FORCE])
    memory[FORCE] = force
    if abs(speed) > APPROACHING * approach:
        memory[STIFFNESS] = max(0.0, memory[PRODUCTS] / memory[SQUARES])


@inlined
def forget_stiffness(memory: OutVector, force: float) -> None:
    """Reset a memory (4,), given the present force in N along the axis of the push, in any frame."""
    memory[SQUARES], memory[PRODUCTS], memory[FORCE], memory[STIFFNESS] = 0.0, 0.0, force, 0.0
