"""What is claimed of a plan, in words: of the whole problem, or of which part of it, and of which durations."""

from __future__ import annotations

from collections.abc import Collection
from typing import Literal, TypeAlias, assert_never

from skillc_runtime.planning.left_out import Kind, LeftOut

Optimal: TypeAlias = Literal[
    "proven", "optimal for the filtered problem", "optimal for approximate durations", "best found"
]

PARTS: dict[Kind, str] = {
    "individuals": "the part of the scene that was planned with",
    "skills": "the skills that can be planned with",
    "steps": "the steps that have not failed",
}


def quality(optimal: Optimal, left_out: Collection[LeftOut], at_least_s: float | None) -> str:
    """Say how good a plan is known to be, and for what: `proved optimal` speaks of the whole problem."""
    known = "" if at_least_s is None else f", any plan takes at least {at_least_s:g} s"
    missing = {each.kind for each in left_out if not each.harmless}
    parts = [words for kind, words in PARTS.items() if kind in missing]
    match optimal:
        case "proven":
            return "proved optimal"
        case "optimal for the filtered problem":
            return f"optimal for {' and '.join(parts)}{known}"
        case "optimal for approximate durations":
            return f"optimal for {' and '.join([*parts, 'approximate durations'])}{known}"
        case "best found":
            return f"best found, not proved optimal{known}"
        case _:
            assert_never(optimal)
