"""Noticing contact while a tool approaches, gently pushed: it stops, or a force is felt, for long enough to be sure."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

SLOW_SHARE, SLOW_S = 1 / 3, 0.02
"""A tool that has moved and then stays this much below its approach speed, for this long, has been stopped."""

FELT_N, FELT_S = 2.0, 0.005
"""A force above this, for this long, is contact; only once the tool moves, since starting takes force as well."""

STUCK_S = 0.5
"""A tool that has not begun to move after this long was touching from the start."""


@dataclass(frozen=True, slots=True)
class Approach:
    """An approach with `speed` m/s over at most `travel` m, and how it goes: times in s, `depth` in m."""

    speed: float
    travel: float
    elapsed: float = 0.0
    moved: bool = False
    slow: float = 0.0
    felt: float = 0.0
    depth: float = 0.0

    @property
    def outcome(self) -> Literal["approaching", "touching", "missing"]:
        """What is known by now; `missing` when nothing was there within the travel."""
        if self.slow >= SLOW_S or self.felt >= FELT_S or (not self.moved and self.elapsed >= STUCK_S):
            return "touching"
        return "missing" if self.depth > self.travel else "approaching"


def advance(approach: Approach, speed: float, force_n: float, period: float) -> Approach:
    """Go on by `period` s: `speed` m/s towards the surface, `force_n` N with which something pushes back."""
    moved = approach.moved or speed > 2 * SLOW_SHARE * approach.speed
    slow = moved and speed < SLOW_SHARE * approach.speed
    felt = moved and force_n > FELT_N
    return replace(
        approach,
        elapsed=approach.elapsed + period,
        moved=moved,
        slow=approach.slow + period if slow else 0.0,
        felt=approach.felt + period if felt else 0.0,
        depth=approach.depth + speed * period,
    )
