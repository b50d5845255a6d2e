"""Evaluates, once a control period, a tool's approach to what it is to be pressed on, and later whether it is borne.

What an arm feels contains the force that speeds it up or slows it down; so no force is believed before the tool
approaches steadily, however it moved when the approach began.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias, assert_never

from skillc_runtime.devices.arm import ArmState
from skillc_runtime.devices.arm_driver import Contact, GuardedPush, Standstill, StopCondition, Travel
from skillc_runtime.motion.pose import Array

STEADY_SHARE, STEADY_S = (2 / 3, 3 / 2), 0.02
"""A tool approaches when its speed is within these shares of the approach speed, for this long."""

FALL_SHARE, FALL_S = 2.0, 0.01
"""A pressed tool that goes faster than this share of its approach speed, for this long, meets nothing any more; the arm
brakes it."""


@dataclass(frozen=True, slots=True)
class Approach:
    """An approach with `speed` m/s until one of some conditions is met.

    steady_s: s for which it has gone steadily; held_s: s for which each condition has held; depth: m gone so far.
    """

    speed: float
    conditions: tuple[StopCondition, ...]
    held_s: tuple[float, ...]
    steady: float = 0.0
    depth: float = 0.0

    @property
    def has_moved(self) -> bool:
        """Whether the tool has approached steadily."""
        return self.steady >= STEADY_S

    @property
    def met(self) -> StopCondition | None:
        """The first of the conditions that is met."""
        return next((each for each, s in zip(self.conditions, self.held_s, strict=True) if self._is_met(each, s)), None)

    def _is_met(self, condition: StopCondition, held_s: float) -> bool:
        match condition:
            case Standstill(for_s=for_s, from_start_s=from_start_s):
                return held_s >= (for_s if self.has_moved else from_start_s)
            case Contact(for_s=for_s):
                return held_s >= for_s
            case Travel(distance_m=distance_m):
                return self.depth > distance_m
            case _:
                assert_never(condition)


def begin_approach(push: GuardedPush) -> Approach:
    """Return the approach of a push before it has moved."""
    conditions = (*push.touch_conditions, push.travel)
    return Approach(push.approach_m_s, conditions, (0.0,) * len(conditions))


def advance_approach(approach: Approach, speed: float, force_n: float, period: float) -> Approach:
    """Go on by `period` s: `speed` m/s towards the surface, `force_n` N with which something pushes back."""
    least, most = (share * approach.speed for share in STEADY_SHARE)
    steady = approach.steady + period if least < speed < most else 0.0
    moved = approach.has_moved or steady >= STEADY_S

    def holds(condition: StopCondition) -> bool:
        match condition:
            case Standstill(share=share):
                return speed < share * approach.speed
            case Contact(force_n=least_n):
                return moved and force_n > least_n
            case Travel():
                return False
            case _:
                assert_never(condition)

    conditions = zip(approach.conditions, approach.held_s, strict=True)
    return replace(
        approach,
        steady=max(approach.steady, STEADY_S) if moved else steady,
        held_s=tuple(held + period if holds(condition) else 0.0 for condition, held in conditions),
        depth=approach.depth + speed * period,
    )


@dataclass(frozen=True, slots=True)
class Pressing:
    """A tool that is pressed on what it approached with `speed` m/s; it has gone too fast for that for `fast` s."""

    speed: float
    fast: float = 0.0

    @property
    def falling(self) -> bool:
        """Whether there is nothing any more that bears the press."""
        return self.fast >= FALL_S


def advance_pressing(pressed: Pressing, speed: float, period: float) -> Pressing:
    """Go on by `period` s with `speed` m/s in the direction of the press."""
    return replace(pressed, fast=pressed.fast + period if speed > FALL_SHARE * pressed.speed else 0.0)


@dataclass(frozen=True, slots=True)
class GivenUp:
    """The push is over: nothing was met, or contact was lost for good."""

    reason: str


PushAction: TypeAlias = Literal["go on", "approach", "press"] | GivenUp
"""What to do with the push: leave it, push gently, push with the full force, or end it."""


class ActivePush:
    """A push under way, implementing `PushProgress`. axis (3,): its direction, out of the surface, in base axes."""

    def __init__(self, push: GuardedPush, axis: Array) -> None:
        self.push, self._axis = push, axis
        self._phase: Approach | Pressing = begin_approach(push)
        self._surface_m: float | None = None

    @property
    def has_touched(self) -> bool:
        """Whether something has been met."""
        return self._surface_m is not None

    def step(self, state: ArmState, contact_wrench: Callable[[], Array], period: float) -> PushAction:
        """Go on by `period` s; `contact_wrench` returns what the environment does to the tool (6,), N, base axes."""
        height = float(self._axis @ state.tool.position)
        speed = -float(self._axis @ (state.jacobian[:3] @ state.dq))
        travel_m = self.push.travel.distance_m
        if self._surface_m is not None and self._surface_m - height > travel_m:
            return GivenUp(f"contact was lost: the tool sank by {travel_m * 100:.0f} cm")
        match self._phase:
            case Approach():
                return self._go_nearer(self._phase, speed, height, float(self._axis @ contact_wrench()[:3]), period)
            case Pressing():
                self._phase = advance_pressing(self._phase, speed, period)
                if not self._phase.falling:
                    return "go on"
                self._phase = begin_approach(self.push)
                return "approach"
            case _:
                assert_never(self._phase)

    def _go_nearer(self, approach: Approach, speed: float, height: float, force_n: float, period: float) -> PushAction:
        self._phase = approach = advance_approach(approach, speed, force_n, period)
        match approach.met:
            case None:
                return "go on"
            case Travel(distance_m=distance_m):
                return GivenUp(f"nothing to push against within {distance_m * 100:.0f} cm")
            case Contact() | Standstill():
                self._phase = Pressing(self.push.approach_m_s)
                self._surface_m = height if self._surface_m is None else self._surface_m
                return "press"
