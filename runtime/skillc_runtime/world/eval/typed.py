"""Whether a value is of a type of the language."""

from __future__ import annotations

from typing import assert_never

from skillc_compiler.library.vocabulary import (
    ClassType,
    DirectionType,
    ListType,
    NumberType,
    PlainType,
    ValueType,
    VectorType,
)
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.state.values import Value, finite
from skillc_runtime.world.state.vectors import is_direction, is_vector
from skillc_runtime.world.state.world_state import WorldState


def is_of(value: Value, type_: ValueType, state: WorldState) -> bool:
    """Whether a value is of a type; an individual must be in the world, a number finite, a direction of length 1."""
    match type_:
        case ClassType(iri=iri):
            return isinstance(value, str) and value in state.individuals and state.is_a(value, iri)
        case NumberType():
            return isinstance(value, int | float) and not isinstance(value, bool) and finite(value)
        case VectorType():
            return is_vector(value) and finite(value)
        case DirectionType():
            return is_direction(value)
        case PlainType(name=name):
            return _is_plain(value, name)
        case ListType(element=element):
            return isinstance(value, tuple) and all(is_of(part, element, state) for part in value)
        case _:
            assert_never(type_)


def _is_plain(value: Value, name: str) -> bool:
    kinds: dict[str, type | tuple[type, ...]] = {"Bool": bool, "Int": int, "Text": str, "Pose": Pose}
    return isinstance(value, kinds[name]) and (name == "Bool" or not isinstance(value, bool))
