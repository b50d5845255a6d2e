"""Noticing contact while a tool approaches, gently pushed: it stops, or a force is felt, for long enough to be sure.
And noticing, once it is pressed, that what it was pressed on is not there any more: it goes faster than it approached.

What an arm feels contains the force that speeds it up or slows it down; so nothing is believed before it approaches
steadily, however it moved when the approach began.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

STEADY_SHARE, STEADY_S = (2 / 3, 3 / 2), 0.02
"""A tool approaches when its speed is within these shares of the approach speed, for this long."""

SLOW_SHARE, SLOW_S = 1 / 3, 0.02
"""A tool that has approached and then stays this much below its approach speed, for this long, has been stopped."""

FELT_N, FELT_S = 2.0, 0.005
"""A force above this, for this long, is contact."""

STUCK_S = 0.5
"""A tool that stands for so long before it has approached was touching from the start, or is by now."""

FALL_SHARE, FALL_S = 2.0, 0.01
"""A pressed tool that goes faster than this share of its approach speed, for this long, meets nothing any more; the arm
brakes it."""


@dataclass(frozen=True, slots=True)
class Approach:
    """An approach with `speed` m/s over at most `travel` m, and how it goes: times in s, `depth` in m."""

    speed: float
    travel: float
    steady: float = 0.0
    slow: float = 0.0
    felt: float = 0.0
    depth: float = 0.0

    @property
    def moved(self) -> bool:
        """Whether the tool has approached steadily."""
        return self.steady >= STEADY_S

    @property
    def outcome(self) -> Literal["approaching", "touching", "missing"]:
        """What is known by now; `missing` when nothing was there within the travel."""
        if self.slow >= (SLOW_S if self.moved else STUCK_S) or self.felt >= FELT_S:
            return "touching"
        return "missing" if self.depth > self.travel else "approaching"


def advance(approach: Approach, speed: float, force_n: float, period: float) -> Approach:
    """Go on by `period` s: `speed` m/s towards the surface, `force_n` N with which something pushes back."""
    least, most = (share * approach.speed for share in STEADY_SHARE)
    steady = approach.steady + period if least < speed < most else 0.0
    moved = approach.moved or steady >= STEADY_S
    slow = speed < SLOW_SHARE * approach.speed
    felt = moved and force_n > FELT_N
    return replace(
        approach,
        steady=max(approach.steady, STEADY_S) if moved else steady,
        slow=approach.slow + period if slow else 0.0,
        felt=approach.felt + period if felt else 0.0,
        depth=approach.depth + speed * period,
    )


@dataclass(frozen=True, slots=True)
class Pressed:
    """A tool that is pressed on what it approached with `speed` m/s; it has gone too fast for that for `fast` s."""

    speed: float
    fast: float = 0.0

    @property
    def falling(self) -> bool:
        """Whether there is nothing any more that bears the press."""
        return self.fast >= FALL_S


def go_on(pressed: Pressed, speed: float, period: float) -> Pressed:
    """Go on by `period` s with `speed` m/s in the direction of the press."""
    return replace(pressed, fast=pressed.fast + period if speed > FALL_SHARE * pressed.speed else 0.0)
