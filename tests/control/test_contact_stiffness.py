"""The stiffness of what a tool approaches is found, and the force loop is stable whatever it is."""

from collections import deque

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc_runtime.control.contact_stiffness import (
    FORCE,
    STIFFNESS,
    forget_stiffness,
    identify_stiffness,
    stiffest_contact,
)
from skillc_runtime.control.passivity import make_tank, watch_energy

ADMITTANCE, LAG_S, APPROACH_M_S, PERIOD_S = 0.008, 0.03, 0.05, 0.001
GAP_M = 0.005

stiffnesses = st.floats(3.0, 5.3).map(lambda power: 10.0**power)


def press(stiffness: float, delay_s: float, known_s: float = 0.0, adapts: bool = True, noise_n: float = 0.0) -> tuple:
    """Push a tool by an admittance with a lag against a spring; return forces (n,) in N and the stiffness found, N/m.

    The tool moves `delay_s` late, of which the law knows `known_s`. A tank keeps it passive, as in the law.
    """
    x, v, memory, late = -GAP_M, 0.0, np.zeros(4), deque([0.0] * (1 + round(delay_s / PERIOD_S)))
    tank = make_tank()
    wanted, forces, rng = APPROACH_M_S / ADMITTANCE, [], np.random.default_rng(0)
    for _ in range(4000):
        forces.append(stiffness * max(x, 0.0))
        late.append(v)
        moving = late.popleft()
        felt = forces[-1] + noise_n * rng.standard_normal()
        identify_stiffness(memory, v, -felt, APPROACH_M_S, PERIOD_S)
        stiffest = stiffest_contact(ADMITTANCE, LAG_S, known_s)
        passive = watch_energy(tank, np.full(1, wanted - felt), np.full(1, moving), PERIOD_S)
        share = min(passive, stiffest / max(memory[STIFFNESS], 1.0)) if adapts else 1.0
        v += (1.0 - np.exp(-PERIOD_S / LAG_S)) * (share * ADMITTANCE * (wanted - felt) - v)
        x += PERIOD_S * moving
    return np.array(forces), float(memory[STIFFNESS])


@given(stiffnesses)
def test_the_stiffness_is_found_while_the_tool_approaches(stiffness: float) -> None:
    _, found = press(stiffness, 0.0)
    assert 0.6 * stiffness < found < 1.4 * stiffness


@settings(deadline=None)
@given(stiffnesses, st.integers(0, 8), st.floats(0.0, 1.0))
def test_no_stiffness_and_no_delay_makes_the_tool_oscillate(stiffness: float, periods: int, share: float) -> None:
    """The delay is at most what the law knows of it, in whole periods; the force comes to rest at what is wanted."""
    known_s = periods * PERIOD_S
    forces, _ = press(stiffness, PERIOD_S * int(share * periods), known_s)
    np.testing.assert_allclose(forces[-500:], APPROACH_M_S / ADMITTANCE, rtol=0.05)


def test_the_admittance_of_the_sheet_alone_oscillates_at_a_stiff_contact() -> None:
    forces, _ = press(80e3, 0.005, adapts=False)
    assert np.ptp(forces[-500:]) > APPROACH_M_S / ADMITTANCE


def test_noise_alone_is_no_stiff_contact() -> None:
    """0.5 N of noise at a pad of felt leave the admittance as it is."""
    _, found = press(8000.0, 0.0, noise_n=0.5)
    assert found < stiffest_contact(ADMITTANCE, LAG_S, 0.0)


def test_a_new_push_begins_anew() -> None:
    memory = np.full(4, 7.0)
    forget_stiffness(memory, 2.0)
    assert memory[STIFFNESS] == 0.0
    assert memory[FORCE] == 2.0
