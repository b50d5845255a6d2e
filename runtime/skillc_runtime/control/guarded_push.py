"""Evaluates a guarded push once a control period: the approach of the tool to a surface, then the contact.

A tool that is held, in a pause, approaches again afterwards.
The measured force contains the force that accelerates the tool, so it is used only after the tool has approached with
a steady speed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias, assert_never

from skillc_runtime.control.push_force import PushForceMeter
from skillc_runtime.devices.arm import ArmState
from skillc_runtime.devices.guarded_push import (
    Contact,
    GuardedPush,
    MeasuredForce,
    Standstill,
    StopCondition,
    Travel,
)
from skillc_runtime.motion.pose import Array

STEADY_SHARE, STEADY_S = (2 / 3, 3 / 2), 0.02
"""A tool approaches steadily when its speed has been within these shares of the approach speed for this time."""

FALL_SHARE, FALL_S = 2.0, 0.01
"""A tool that has moved faster than this multiple of its approach speed for this time has lost contact; the arm brakes
it."""


@dataclass(frozen=True, slots=True)
class Approach:
    """An approach with `speed` m/s until one of the conditions is met.

    steady: s for which it has been steady; held_s: for which each condition has been true; depth: m moved so far.
    """

    speed: float
    conditions: tuple[StopCondition, ...]
    held_s: tuple[float, ...]
    steady: float = 0.0
    depth: float = 0.0

    @property
    def has_moved(self) -> bool:
        """Whether the tool has moved steadily at some time."""
        return self.steady >= STEADY_S

    @property
    def met(self) -> StopCondition | None:
        """The first condition that is met."""
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
    """Return the approach of a push at its start."""
    conditions = (*push.touch_conditions, push.travel)
    return Approach(push.approach_m_s, conditions, (0.0,) * len(conditions))


def advance_approach(approach: Approach, speed: float, force_n: float, period: float) -> Approach:
    """Advance by `period` s: `speed` m/s towards the surface, `force_n` N of the surroundings against the tool."""
    least, most = (share * approach.speed for share in STEADY_SHARE)
    steady = approach.steady + period if least < speed < most else 0.0
    moved = approach.has_moved or steady >= STEADY_S

    def holds(condition: StopCondition) -> bool:
        match condition:
            case Standstill(share=share):
                return abs(speed) < share * approach.speed
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
    """A tool in contact for `lasted` s after an approach with `speed` m/s.

    It has moved too fast for that for `fast` s.
    """

    speed: float
    fast: float = 0.0
    lasted: float = 0.0

    @property
    def falling(self) -> bool:
        """Whether contact was lost."""
        return self.fast >= FALL_S


def advance_pressing(pressed: Pressing, speed: float, period: float) -> Pressing:
    """Advance by `period` s with `speed` m/s in the direction of the push."""
    fast = pressed.fast + period if speed > FALL_SHARE * pressed.speed else 0.0
    return Pressing(pressed.speed, fast, pressed.lasted + period)


@dataclass(frozen=True, slots=True)
class Held:
    """A tool that neither approaches nor presses."""


@dataclass(frozen=True, slots=True)
class GivenUp:
    """The push has failed: there was no contact within the travel, or contact was lost."""

    reason: str


PushAction: TypeAlias = Literal["go on", "approach", "press"] | GivenUp
"""What the arm must do next: continue, push gently, push with the full force, or end the push."""


class ActivePush:
    """A push in progress, implementing `PushProgress`. axis (3,): the unit vector out of the surface, in base axes.

    felt: returns the wrench (6,) that is measured on the tool, N and N m, base axes; None where nothing measures it.
    """

    def __init__(self, push: GuardedPush, axis: Array, felt: Callable[[], Array | None]) -> None:
        self.push, self._axis = push, axis
        self._meter = PushForceMeter(axis, felt)
        self._phase: Approach | Pressing | Held = begin_approach(push)
        self._surface_m: float | None = None

    @property
    def pressed_s(self) -> float | None:
        """For how long the tool has been in contact, in s; None if it is not."""
        return self._phase.lasted if isinstance(self._phase, Pressing) else None

    @property
    def force(self) -> MeasuredForce:
        """What was measured of its force up to now."""
        return self._meter.mean

    def hold(self) -> None:
        """Neither approach nor press until `approach`."""
        self._phase = Held()

    def approach(self) -> None:
        """Approach after `hold`."""
        self._phase = begin_approach(self.push)

    def step(self, state: ArmState, contact_wrench: Callable[[], Array], period: float) -> PushAction:
        """Advance by `period` s; `contact_wrench` returns the wrench (6,) on the tool, N and N m, base axes."""
        height = float(self._axis @ state.tool.position)
        speed = -float(self._axis @ (state.jacobian[:3] @ state.dq))
        travel_m = self.push.travel.distance_m
        if self._surface_m is not None and self._surface_m - height > travel_m:
            return GivenUp(f"contact was lost: the tool sank by {travel_m * 100:.0f} cm")
        match self._phase:
            case Approach():
                force_n = float(self._axis @ contact_wrench()[:3])
                return self._step_approach(self._phase, speed, height, force_n, period)
            case Pressing():
                self._phase = advance_pressing(self._phase, speed, period)
                self._meter.press(self._phase.lasted, period)
                if not self._phase.falling:
                    return "go on"
                self.approach()
                return "approach"
            case Held():
                return "go on"
            case _:
                assert_never(self._phase)

    def _step_approach(
        self, approach: Approach, speed: float, height: float, force_n: float, period: float
    ) -> PushAction:
        self._phase = approach = advance_approach(approach, speed, force_n, period)
        self._meter.approach(approach.has_moved, period)
        match approach.met:
            case None:
                return "go on"
            case Travel(distance_m=distance_m):
                return GivenUp(f"nothing to push against within {distance_m * 100:.0f} cm")
            case Contact() | Standstill():
                self._phase = Pressing(self.push.approach_m_s)
                self._surface_m = height if self._surface_m is None else self._surface_m
                return "press"
