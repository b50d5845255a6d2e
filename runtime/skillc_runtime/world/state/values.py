"""The values that properties, parameters and expressions have at run time."""

from __future__ import annotations

import math
from typing import TypeAlias

from skillc_runtime.motion.arrays import Array, np
from skillc_runtime.motion.pose import Pose

Value: TypeAlias = "bool | int | float | str | Pose | Array | tuple[Value, ...]"
"""Numbers in SI units, individuals as IRIs, vectors as arrays (3,), several values and lists as tuples."""


def are_equal(one: Value, other: Value) -> bool:
    """Whether two values are equal: numbers by value (3 = 3.0), poses and vectors by component."""
    if isinstance(one, Pose) and isinstance(other, Pose):
        return np.array_equal(one.position, other.position) and np.array_equal(one.rotation, other.rotation)
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return np.array_equal(one, other)
    if isinstance(one, tuple) and isinstance(other, tuple):
        return len(one) == len(other) and all(are_equal(a, b) for a, b in zip(one, other, strict=True))
    if isinstance(one, Pose | np.ndarray) or isinstance(other, Pose | np.ndarray):
        return False
    return one == other


def has_value(stored: Value | None, value: Value) -> bool:
    """Whether a stored value equals a value, or is a tuple that contains it."""
    return stored is not None and any(
        are_equal(one, value) for one in (stored if isinstance(stored, tuple) else (stored,))
    )


def is_finite(value: Value) -> bool:
    """Whether no number in the value is NaN or infinite."""
    if isinstance(value, float):
        return math.isfinite(value)
    if isinstance(value, np.ndarray):
        return bool(np.isfinite(value).all())
    if isinstance(value, Pose):
        return is_finite(value.position) and is_finite(value.rotation)
    return all(is_finite(part) for part in value) if isinstance(value, tuple) else True


def to_json(value: Value) -> object:
    """Return a value for JSON; poses as text."""
    if isinstance(value, tuple):
        return [to_json(part) for part in value]
    if isinstance(value, np.ndarray):
        return value.tolist()
    return show(value) if isinstance(value, Pose) else value


def show(value: Value) -> str:
    """Return a value as text for people, numbers in SI units."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return f"{value:g}"
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, Pose):
        return f"pose at {show(value.position)}"
    if isinstance(value, np.ndarray):
        return "(" + ", ".join(f"{float(part) + 0.0:g}" for part in value.ravel()) + ")"
    return "[" + ", ".join(show(part) for part in value) + "]" if isinstance(value, tuple) else str(value)
