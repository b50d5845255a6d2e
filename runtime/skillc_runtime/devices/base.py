"""The interface of a mobile base, simulated or real."""

from __future__ import annotations

from typing import Protocol

from skillc_runtime.devices.arm import NotOffered
from skillc_runtime.motion.pose import Pose


class MobileBase(Protocol):
    """A base that drives on the floor; poses are of its centre on the floor, in the world frame."""

    @property
    def pose(self) -> Pose:
        """The pose of the base."""
        ...

    @property
    def done(self) -> bool:
        """Whether the base has arrived at the last goal."""
        ...

    @property
    def at_rest(self) -> bool:
        """Whether the base does not move, at a goal or elsewhere."""
        ...

    @property
    def fault(self) -> str | None:
        """Why the base stopped by itself on the way to the last goal, for example its bumper; None if it did not."""
        ...

    @property
    def speed(self) -> float:
        """The share, above 0 to 1, of its speeds with which the base drives."""
        return 1.0

    def set_speed(self, share: float) -> None:
        """Drive with this share of the speeds from the next goal on; NotOffered if something else chooses them."""
        if share < 1.0:
            raise NotOffered("the speed of the base is chosen by its own navigation: lower it there")

    def drive_to(self, goal: Pose) -> None:
        """Begin to drive to a `goal`: rotate towards it, drive straight, rotate to its heading; returns at once.

        A moving base brakes first.
        """
        ...

    def stop(self) -> None:
        """Brake; `done` is false until the next goal."""
        ...
