"""How fast an arm may approach what it is to press on, so that the first impact stays below its contact force limit.

A tool that touches with the speed v goes on for the time T in which the arm reacts: the lag of its admittance, and the
greatest delay of its commands; an arm that takes torques yields at once. Its moving mass m is then stopped by the pad,
of stiffness K. With the force F that is pushed with, F + K T v + v sqrt(K m) <= F_max, so that

    v <= (F_max - F) / (K T + sqrt(K m)),   m = M / 2 + m_tool

where M is the mass of the moving parts: ISO/TS 15066:2016, A.3.4. K is the greatest that the tool's sheet allows for.
Where people share the cell, F_max and v are no more than the regions of their bodies bear: `world.space.shared_cell`.
"""

from __future__ import annotations

from math import sqrt
from typing import Final

from skillc_runtime.world.space.shared_cell import find_shared_limit
from skillc_runtime.world.state.data_sheet import DataSheet, SheetError, number_of, sheet_of
from skillc_runtime.world.state.terms import CONTAIN, HAS_GRIPPER, TOOL, WEIGHT
from skillc_runtime.world.state.world_state import WorldState

SLOWEST_M_S: Final = 0.005
"""No approach need be slower: within a period its force grows by less than that of a pad of any stiffness."""


def greatest_approach(most_n: float, stiffness: float, reaction_s: float, mass_kg: float) -> float:
    """Return the greatest speed in m/s with which a pad may be touched.

    most_n: N, the greatest force less that which is pushed with.
    stiffness: N/m, K of the pad.
    reaction_s: s, T.
    mass_kg: kg, m.
    """
    return max(most_n / (stiffness * reaction_s + sqrt(stiffness * mass_kg)), SLOWEST_M_S)


def find_greatest_approach(state: WorldState, arm: str, force_n: float) -> float:
    """Return how fast an arm may approach with what it holds, in m/s; infinite where the sheets do not say enough.

    force_n: N, with which it is to push.
    """
    shared = find_shared_limit(state, arm)
    held = [thing for hand in state.objects(arm, HAS_GRIPPER) for thing in state.objects(hand, CONTAIN)]
    tools = sorted(each for each in held if state.is_a(each, TOOL))
    try:
        sheet, pad = sheet_of(state, arm), sheet_of(state, tools[0]) if tools else None
    except SheetError:
        return shared.speed_m_s
    needed = all(sheet.has(each) for each in ("contactForceLimit", "movingMass"))
    if pad is None or not needed or not pad.has("padStiffness"):
        return shared.speed_m_s
    mass_kg = sheet.number("movingMass") / 2 + number_of(state, tools[0], WEIGHT, default=0.0)
    most_n = min(sheet.number("contactForceLimit"), shared.force_n) - force_n
    fastest = greatest_approach(most_n, find_stiffest(pad), find_reaction_s(sheet), mass_kg)
    return min(fastest, shared.speed_m_s)


def find_stiffest(pad: DataSheet) -> float:
    """Return the greatest stiffness in N/m that the pad of a tool may have."""
    factor = float(pad.numbers("padStiffnessFactor")[1]) if pad.has("padStiffnessFactor") else 1.0
    return pad.number("padStiffness") * factor


def find_reaction_s(arm: DataSheet) -> float:
    """Return the time in s in which an arm that yields by what it feels reacts; 0 for one that takes torques."""
    if not arm.has("admittanceTime"):
        return 0.0
    late = [float(arm.numbers(each)[1]) for each in ("commandDelay", "commandJitter") if arm.has(each)]
    return arm.number("admittanceTime") + sum(late)
