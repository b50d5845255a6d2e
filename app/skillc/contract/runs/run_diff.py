"""The differences between two runs."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

import msgspec

Part: TypeAlias = Literal["settings", "requests", "plan", "choices", "outcomes", "measures", "times", "signals"]
"""What is compared, in the order in which one difference may cause another."""
Leaf: TypeAlias = str | float | int | bool | None


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


class OtherRun(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The operation to compare with."""

    other: Annotated[str, msgspec.Meta(max_length=200)]
