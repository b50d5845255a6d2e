"""Vectors in properties: parsing, formatting, and the check for directions."""

from __future__ import annotations

import re
from math import isfinite
from typing import TypeGuard

from skillc_runtime.motion.arrays import Array, np

UNIT_WITHIN = 1e-3
"""The tolerance for the length of a direction, unitless: files state it with three or four decimals."""
_NUMBER = re.compile(r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?")


def parse_vector(text: str) -> Array | None:
    """Return the vector (3,) of a text with three numbers separated by spaces, in SI units; None for other texts."""
    numbers = _three_numbers(text)
    if not numbers or not all(map(isfinite, numbers)):
        return None
    vector = np.array(numbers)
    vector.setflags(write=False)
    return vector


def is_too_large(text: str) -> bool:
    """Whether a text consists of three numbers of which one is too large for a float."""
    return not all(map(isfinite, _three_numbers(text)))


def _three_numbers(text: str) -> list[float]:
    parts = text.split()
    stated = len(parts) == 3 and all(_NUMBER.fullmatch(part) for part in parts)
    return [float(part) for part in parts] if stated else []


def format_vector(vector: Array) -> str:
    """Return the text from which `parse_vector` reads the same vector."""
    return " ".join(repr(float(part)) for part in vector)


def is_vector(value: object) -> TypeGuard[Array]:
    """Whether a value is a vector (3,)."""
    return isinstance(value, np.ndarray) and value.shape == (3,)


def is_direction(value: object) -> bool:
    """Whether a value is a vector (3,) of length 1."""
    return is_vector(value) and abs(float(np.linalg.norm(value)) - 1.0) <= UNIT_WITHIN
