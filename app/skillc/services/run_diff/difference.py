"""A difference between two runs, as a value for the command line and for programs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, TypeAlias

import msgspec

Part: TypeAlias = Literal["settings", "requests", "plan", "choices", "outcomes", "measures", "times", "signals"]
"""What is compared, in the order in which one difference may cause another."""
Leaf: TypeAlias = str | float | int | bool | None
Pair: TypeAlias = tuple[Leaf, Leaf]


class Difference(msgspec.Struct, frozen=True):
    """`what` is not the same in two runs; a value is None where a run has none.

    `size` orders the differences of a part: between numbers, how far they are apart, in s for times, and for signals in
    parts of their range; 0 where there is no order but that of the run.
    """

    part: Part
    what: str
    first: Leaf
    second: Leaf
    size: float = 0.0


class RunDiff(msgspec.Struct, frozen=True):
    """The differences between two runs, in the order of their parts; `compared` is how much of each part there was.

    `notes` say what could not be compared, and why.
    """

    runs: tuple[str, str]
    compared: dict[Part, int]
    differences: tuple[Difference, ...]
    notes: tuple[str, ...] = ()


def find_difference(part: Part, what: str, pair: Pair, size: float = 0.0) -> tuple[Difference, ...]:
    """Return the difference between two values, or nothing if they are equal."""
    return () if pair[0] == pair[1] else (Difference(part, what, *pair, size),)


def compare_mappings(part: Part, first: Mapping[str, Leaf], second: Mapping[str, Leaf]) -> tuple[Difference, ...]:
    """Return the values that differ, by name; a name that one mapping does not have is None there."""
    names = dict.fromkeys((*first, *second))
    return tuple(each for name in names for each in find_difference(part, name, (first.get(name), second.get(name))))
