"""What an arm may do where people share its cell: limits by the regions of their bodies that it may meet.

A contact that lasts bears no more than the least quasi-static limit of these regions. One in which the region gives way
has the energy of the relative motion, mu v^2 / 2, that the stiffness k of the region takes up with the force F, so that

    v <= F / sqrt(mu k),   1 / mu = 1 / m_H + 1 / m_R,   m_R = M / 2 + m_L

where F is the transient limit, m_H the mass of the region, M that of the moving links of the arm, and m_L the load:
ISO/TS 15066:2016, A.3.2 to A.3.4. The arm is taken to be the faster of both.
"""

from __future__ import annotations

from math import inf, sqrt
from typing import Final

import msgspec

from skillc_runtime.world.state.data_sheet import number_of, sheet_of
from skillc_runtime.world.state.terms import MANIPULATABLE, MAY_MEET, MOVING_MASS, SKILLC, WEIGHT
from skillc_runtime.world.state.world_state import WorldState

QUASI_STATIC, TRANSIENT, STIFFNESS, MASS = (
    SKILLC + name for name in ("quasiStaticLimit", "transientLimit", "bodyStiffness", "bodyMass")
)


class SharedLimit(msgspec.Struct, frozen=True):
    """The greatest force in N of a contact that lasts, and the greatest speed in m/s of arm and tool.

    weakest, slowest: the regions from which they follow; empty where nobody shares the cell.
    """

    force_n: float
    speed_m_s: float
    weakest: str = ""
    slowest: str = ""


UNSHARED: Final = SharedLimit(inf, inf)


def compute_greatest_speed(transient_n: float, stiffness: float, body_kg: float, robot_kg: float) -> float:
    """Return the greatest relative speed in m/s of a robot and a region of a body that gives way.

    transient_n: N, F.
    stiffness: N/m, k, of the region.
    body_kg, robot_kg: m_H and m_R.
    """
    return transient_n / sqrt(stiffness / (1.0 / body_kg + 1.0 / robot_kg))


def find_shared_limit(state: WorldState, arm: str) -> SharedLimit:
    """Return the limits of an arm by the regions that it may meet; infinite without any.

    Its load is the heaviest thing of the world. SheetError if a fact is missing.
    """
    regions = sorted(state.objects(arm, MAY_MEET))
    if not regions:
        return UNSHARED
    loads = (number_of(state, each, WEIGHT, default=0.0) for each in state.instances(MANIPULATABLE))
    robot_kg = number_of(state, sheet_of(state, arm).individual, MOVING_MASS) / 2 + max(loads, default=0.0)
    forces = {each: number_of(state, each, QUASI_STATIC) for each in regions}
    speeds = {each: _speed_at(state, each, robot_kg) for each in regions}
    weakest, slowest = min(regions, key=lambda each: forces[each]), min(regions, key=lambda each: speeds[each])
    return SharedLimit(forces[weakest], speeds[slowest], weakest, slowest)


def _speed_at(state: WorldState, region: str, robot_kg: float) -> float:
    force_n, stiffness, body_kg = (number_of(state, region, name) for name in (TRANSIENT, STIFFNESS, MASS))
    return compute_greatest_speed(force_n, stiffness, body_kg, robot_kg)
