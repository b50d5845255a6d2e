"""The friction that a thing may really have."""

from __future__ import annotations

from skillc_runtime.world.state.data_sheet import SheetError, number_of
from skillc_runtime.world.state.terms import FRICTION, FRICTION_HIGH, FRICTION_LOW
from skillc_runtime.world.state.world_state import WorldState


def read_friction_range(state: WorldState, thing: str) -> tuple[float, float]:
    """Return the least and the greatest friction: the range where one of its ends is given, else the one value."""
    if not has_friction_range(state, thing):
        believed = number_of(state, thing, FRICTION)
        return believed, believed
    low, high = number_of(state, thing, FRICTION_LOW), number_of(state, thing, FRICTION_HIGH)
    if low > high:
        short = state.vocabulary.short
        raise SheetError(f"{short(thing)} has a {short(FRICTION_LOW)} above its {short(FRICTION_HIGH)}")
    return low, high


def has_friction_range(state: WorldState, thing: str) -> bool:
    """Tell whether a range is given, or an end of one."""
    return any(state.value(thing, end) is not None for end in (FRICTION_LOW, FRICTION_HIGH))
