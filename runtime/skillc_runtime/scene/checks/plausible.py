"""Checks orientations and ranges of friction, which the axioms do not cover."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot

from skillc_runtime.scene.violation import SceneViolation, stored_values
from skillc_runtime.world.state.terms import (
    FRICTION,
    FRICTION_HIGH,
    FRICTION_LOW,
    ORIENTATION,
    SURFACE,
)
from skillc_runtime.world.state.world_state import WorldState

LEAST_NORM, GREATEST_NORM = 0.99, 1.01
"""Limits for the length of a quaternion, which should be 1: numbers in files are rounded."""


def check_plausible(state: WorldState) -> Iterator[SceneViolation]:
    """Yield impossible values; checks of terms that the vocabulary does not have find nothing."""
    for rule in (_rotations, _frictions):
        yield from rule(state)


def _rotations(state: WorldState) -> Iterator[SceneViolation]:
    parts = [dict(stored_values(state, name)) for name in ORIENTATION]
    for individual in parts[0]:
        numbers = [value for part in parts if isinstance(value := part.get(individual), int | float)]
        if len(numbers) == len(parts) and not LEAST_NORM < hypot(*numbers) < GREATEST_NORM:
            written = ", ".join(f"{number:g}" for number in numbers)
            message = (
                f"the orientation ({written}) of {state.vocabulary.short(individual)} is no rotation: "
                f"the length of the quaternion is {hypot(*numbers):.3g} and not 1"
            )
            yield SceneViolation(
                individual, ORIENTATION[0], "no-rotation", message, "for no turn write OrientationW 1.0"
            )


def _frictions(state: WorldState) -> Iterator[SceneViolation]:
    """Yield surfaces without friction or with an incomplete range, and invalid ranges of other objects."""
    if not {FRICTION, FRICTION_LOW, FRICTION_HIGH} <= state.stored.keys():
        return
    ranged = {thing for end in (FRICTION_LOW, FRICTION_HIGH) for thing, _ in stored_values(state, end)}
    for thing in sorted({*state.instances(SURFACE), *ranged}):
        yield from _friction(state, thing)


def _friction(state: WorldState, thing: str) -> Iterator[SceneViolation]:
    short = state.vocabulary.short
    match state.value(thing, FRICTION_LOW), state.value(thing, FRICTION_HIGH):
        case (None, None):
            if state.value(thing, FRICTION) is None:
                message = f"{short(thing)} has no {short(FRICTION)}"
                yield SceneViolation(thing, None, "missing-friction", message, f"write `{short(FRICTION)} NUMBER`")
        case (None, _):
            yield _incomplete_range(state, thing, FRICTION_HIGH, FRICTION_LOW)
        case (_, None):
            yield _incomplete_range(state, thing, FRICTION_LOW, FRICTION_HIGH)
        case (int() | float() as low, int() | float() as high) if low > high:
            message = f"{short(thing)}.{short(FRICTION_LOW)} = {low:g} is above its {short(FRICTION_HIGH)} = {high:g}"
            yield SceneViolation(thing, FRICTION_LOW, "not-a-range", message, "exchange the two")


def _incomplete_range(state: WorldState, thing: str, there: str, lost: str) -> SceneViolation:
    short = state.vocabulary.short
    message = f"{short(thing)} has a {short(there)} and no {short(lost)}"
    return SceneViolation(thing, there, "missing-friction", message, "the two go together")
