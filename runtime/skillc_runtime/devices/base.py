"""The seam to a mobile base, simulated or real."""

from __future__ import annotations

from typing import Protocol

from skillc_runtime.motion.pose import Pose


class MobileBase(Protocol):
    """A base that drives on the floor; poses are of its middle on the floor, in the world."""

    @property
    def pose(self) -> Pose:
        """Where the base is."""
        ...

    @property
    def done(self) -> bool:
        """Whether the base stands at the last goal."""
        ...

    @property
    def at_rest(self) -> bool:
        """Whether the base stands, at a goal or anywhere else."""
        ...

    def drive_to(self, goal: Pose) -> None:
        """Begin to drive to a pose: turn towards it, go straight, turn into its heading; returns at once.

        A moving base brakes first.
        """
        ...

    def stop(self) -> None:
        """Brake; `done` becomes false for good until the next goal."""
        ...
