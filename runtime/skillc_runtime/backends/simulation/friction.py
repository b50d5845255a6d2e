"""The range of the friction of an object."""

from __future__ import annotations

from skillc_runtime.world.state.data_sheet import SheetError, number_of
from skillc_runtime.world.state.terms import FRICTION, FRICTION_HIGH, FRICTION_LOW
from skillc_runtime.world.state.world_state import WorldState


def read_friction_range(state: WorldState, thing: str) -> tuple[float, float]:
    """Return the least and the greatest friction: the range if one of its ends is given, else the single value."""
    if not has_friction_range(state, thing):
        believed = number_of(state, thing, FRICTION)
        return believed, believed
    low, high = number_of(state, thing, FRICTION_LOW), number_of(state, thing, FRICTION_HIGH)
    if low > high:
        short = state.vocabulary.short
        raise SheetError(f"{short(thing)} has a {short(FRICTION_LOW)} above its {short(FRICTION_HIGH)}")
    return low, high


def has_friction_range(state: WorldState, thing: str) -> bool:
    """Tell whether one end of a range is given."""
    return any(state.value(thing, end) is not None for end in (FRICTION_LOW, FRICTION_HIGH))
