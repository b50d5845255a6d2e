"""A displacement of a reference that changes along a line, for a tool that is held beside its motion."""

from __future__ import annotations

import msgspec
import numpy as np
from msgspec.structs import replace

from skillc_runtime.motion.paths.profile import Profile, trapezoidal_profile
from skillc_runtime.motion.pose import Array


class Shift(msgspec.Struct, frozen=True):
    """A displacement that changes from `start` to `end`, each (3,) in m, with a profile of progress 0 to 1.

    All vectors are in the frame of the reference, the arm's base. It begins at `since` s. Times `now` are in s.
    """

    start: Array
    end: Array
    progress: Profile
    since: float

    def at(self, now: float) -> Array:
        """Return displacement, velocity and acceleration (3, 3) in the frame of the reference: m, m/s, m/s^2."""
        share, rate, change = self.progress.at(now - self.since)
        way = self.end - self.start
        return np.array([self.start + share * way, rate * way, change * way])

    def done(self, now: float) -> bool:
        """Tell whether it changes no more."""
        return now - self.since >= self.progress.duration

    def is_over(self, now: float) -> bool:
        """Tell whether there is no displacement any more."""
        return self.done(now) and not self.end.any()

    def towards(self, end: Array, speed: float, acceleration: float, now: float) -> Shift:
        """Return the shift from the present displacement to another one, in the frame of the reference.

        end: (3,) in m.
        speed: m/s.
        acceleration: m/s^2.
        now: s.
        """
        start = self.at(now)[0]
        length = float(np.linalg.norm(end - start))
        if length == 0.0:
            return constant_shift(end)
        return Shift(start, end, trapezoidal_profile(1.0, speed / length, acceleration / length), now)

    def project(self, projection: Array) -> Shift:
        """Return the projected shift; projection (3, 3) in the frame of the reference."""
        return replace(self, start=projection @ self.start, end=projection @ self.end)

    @property
    def numbers(self) -> tuple[float, ...]:
        """The numbers of `ReferencePlan.shift`."""
        return *self.start, *(self.end - self.start), *self.progress.coefficients[:5], self.since


def constant_shift(displacement: Array) -> Shift:
    """Return the shift by a displacement (3,) in m, in the frame of the reference, that does not change."""
    return Shift(displacement, displacement, trapezoidal_profile(0.0, 1.0, 1.0), 0.0)


NO_SHIFT = constant_shift(np.zeros(3))
