"""Compliance of an arm that another process controls."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from typing import Any

from msgspec.structs import replace

from skillc_runtime.backends.control_process.remote.host import ControlProcess
from skillc_runtime.devices.guarded_push import GuardedPush, MeasuredForce, PushProgress
from skillc_runtime.motion.pose import Array, Pose


class RemotePush:
    """Implements `PushProgress` for the push of a number."""

    def __init__(self, process: ControlProcess, number: int) -> None:
        self._process, self.number = process, number

    @property
    def force(self) -> MeasuredForce:
        """What was measured of its force up to now."""
        force: MeasuredForce = self._process.call("compliance", "push_force", self.number)
        return force

    @property
    def pressed_s(self) -> float | None:
        """For how long the tool has been in contact, in s; None if it is not."""
        snapshot = self._process.read()
        if round(snapshot.number("push")) != self.number:
            return None
        pressed_s = snapshot.number("pressed_s")
        return pressed_s if pressed_s >= 0.0 else None


class RemoteCompliance:
    """Implements `ComplianceInterface`; directions (3,) are unit vectors in the world frame."""

    def __init__(self, process: ControlProcess, base: Callable[[], Pose]) -> None:
        self._process, self._base = process, base

    @property
    def commanded_stiffness(self) -> Array:
        """The commanded stiffness (6,) along the axes of the compliance frame, N/m and N m/rad."""
        return self._process.read().field("stiffness").copy()

    @property
    def commanded_force(self) -> Array:
        """The force (3,) N, world axes, on the tool by what it presses on, as it is commanded; NaN without a push."""
        force: Array = self._base().rotation @ self._process.read().field("force")
        return force

    @property
    def released(self) -> bool:
        """Whether any direction is released."""
        return self._process.read().holds("released")

    def tare(self) -> bool:
        """Return True: devices are tared when they are taken under control."""
        return True

    @property
    def tares(self) -> bool:
        """Return False, as said above."""
        return False

    @property
    def force_drift(self) -> float:
        """Return 0, as said above."""
        return 0.0

    def retare(self) -> bool:
        """Return True, as said above."""
        return True

    def release(self, axis: Array, stiffness: float = 0.0) -> None:
        """Release a direction, with a remaining stiffness in N/m.

        Raises ValueError for a nested release that is neither parallel nor perpendicular to the first.
        """
        self._call("release", self._in_base(axis), stiffness)

    def restore(self) -> None:
        """Undo the last release: hold the tool, along the released axis, where it is now. Abandons a motion."""
        self._call("restore")

    def yields_along(self, axis: Array) -> bool:
        """Tell whether a direction is released."""
        return bool(self._call("yields_along", self._in_base(axis)))

    def release_rotation(self) -> None:
        """Release the rotations about the two axes perpendicular to the released one."""
        self._call("release_rotation")

    def restore_rotation(self) -> None:
        """Hold the present rotation of the tool. Abandons a motion."""
        self._call("restore_rotation")

    def push(self, axis: Array, force_n: float, fastest_m_s: float = inf) -> None:
        """Push opposite to a direction, which must be released; ValueError if it is not."""
        self._call("push", self._in_base(axis), force_n, fastest_m_s)

    def push_off(self) -> None:
        """Fade the push out."""
        self._call("push_off")

    def start_push(self, push: GuardedPush) -> PushProgress:
        """Begin to approach and then to push; the result gives the progress."""
        return RemotePush(self._process, self._call("start_push", replace(push, along=self._in_base(push.along))))

    def end_push(self, push: PushProgress) -> None:
        """Stop pushing."""
        self._call("end_push", _number_of(push))

    def pause(self) -> None:
        """Hold the tool along released directions, unless a push is in contact."""
        self._call("pause")

    def withdraw(self, push: PushProgress) -> None:
        """Take the tool off what it presses on, with its approach speed, and hold it there."""
        self._call("withdraw", _number_of(push))

    def resume(self) -> None:
        """Yield again as before `pause` or `withdraw`; a push that was held approaches again.

        While the tool is still being taken off, this does nothing; it is to be called again.
        """
        self._call("resume")

    def _in_base(self, direction: Array) -> Array:
        return self._base().rotation.T @ direction

    def _call(self, name: str, *arguments: Any) -> Any:
        return self._process.call("compliance", name, *arguments)


def _number_of(push: PushProgress) -> int:
    if not isinstance(push, RemotePush):
        raise TypeError("this push is of another arm")
    return push.number
