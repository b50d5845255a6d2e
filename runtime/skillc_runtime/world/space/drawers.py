"""Drawers: things that slide in their furniture, along -y of their own frame, and how far they are open."""

from __future__ import annotations

import msgspec

from skillc_model.rounding import is_above
from skillc_runtime.world.state.data_sheet import SheetError, number_of
from skillc_runtime.world.state.terms import MANIPULATABLE, OPENING, SLIDE_FRICTION, TRAVEL
from skillc_runtime.world.state.world_state import WorldState

SLIDE_FRICTION_N = 3.0
"""The friction of a drawer that states none: of a light one on rollers."""


class Slide(msgspec.Struct, frozen=True):
    """How a drawer slides: at most `travel_m` out, `opening_m` at present, against a friction in N."""

    travel_m: float
    opening_m: float
    friction_n: float


def read_slide(state: WorldState, individual: str) -> Slide | None:
    """Return how a drawer slides, None for what is none; SheetError if its facts contradict each other."""
    short = state.vocabulary.short
    opening_m = number_of(state, individual, OPENING, default=0.0)
    if state.value(individual, TRAVEL) is None:
        if opening_m:
            raise SheetError(f"{short(individual)} is {opening_m:g} m open, and has no {short(TRAVEL)}")
        return None
    travel_m = number_of(state, individual, TRAVEL)
    if state.is_a(individual, MANIPULATABLE):
        raise SheetError(f"{short(individual)} lies free, as a thing to handle, and has a {short(TRAVEL)} of a drawer")
    if is_above(opening_m, travel_m):
        raise SheetError(f"{short(individual)} is {opening_m:g} m open, but slides {travel_m:g} m at most")
    return Slide(travel_m, opening_m, number_of(state, individual, SLIDE_FRICTION, default=SLIDE_FRICTION_N))
