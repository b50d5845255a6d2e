"""What a guarded push is: the approach to a surface, the conditions that end it, and the force afterwards."""

from __future__ import annotations

from typing import Protocol

import msgspec

from skillc_runtime.motion.pose import Array


class Contact(msgspec.Struct, frozen=True):
    """The contact force exceeds `force_n` N for `for_s` s, once the tool approaches steadily."""

    force_n: float = 2.0
    for_s: float = 0.005


class Standstill(msgspec.Struct, frozen=True):
    """The tool is slower than a share of its approach speed for `for_s` s, or `from_start_s` if it has not moved."""

    share: float = 1 / 3
    for_s: float = 0.02
    from_start_s: float = 0.5


class Travel(msgspec.Struct, frozen=True):
    """The tool has moved farther than `distance_m` m."""

    distance_m: float


class GuardedPush(msgspec.Struct, frozen=True):
    """Approach a surface opposite to `along`, a unit vector (3,) in the world, and press on it with `force_n` N.

    There is contact when any of the conditions is met; if it is lost later, the tool approaches again. The arm stops if
    there is no contact within the travel, or the tool sinks by as much after contact.
    """

    along: Array
    force_n: float
    approach_m_s: float
    travel: Travel
    touch_conditions: tuple[Contact | Standstill, ...] = (Standstill(), Contact())


class MeasuredForce(msgspec.Struct, frozen=True):
    """The mean force in N with which a tool presses, as it is measured and not as it is commanded.

    `free_n` was measured before contact, where it should be 0. None is what was not measured, or not for long enough.
    """

    free_n: float | None
    pressed_n: float | None


class PushProgress(Protocol):
    """A guarded push in progress."""

    @property
    def force(self) -> MeasuredForce:
        """What was measured of its force up to now."""
        ...

    @property
    def pressed_s(self) -> float | None:
        """For how long the tool has been in contact, in s; None if it is not."""
        ...
