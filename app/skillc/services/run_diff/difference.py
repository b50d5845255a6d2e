"""A difference between two runs, as a value for the command line and for programs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from skillc.contract.runs.run_diff import Difference, Leaf, Part

Pair: TypeAlias = tuple[Leaf, Leaf]


def find_difference(part: Part, what: str, pair: Pair, size: float = 0.0) -> tuple[Difference, ...]:
    """Return the difference between two values, or nothing if they are equal."""
    return () if pair[0] == pair[1] else (Difference(part, what, *pair, size),)


def compare_mappings(part: Part, first: Mapping[str, Leaf], second: Mapping[str, Leaf]) -> tuple[Difference, ...]:
    """Return the values that differ, by name; a name that one mapping does not have is None there."""
    names = dict.fromkeys((*first, *second))
    return tuple(each for name in names for each in find_difference(part, name, (first.get(name), second.get(name))))
