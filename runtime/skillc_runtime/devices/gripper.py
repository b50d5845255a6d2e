"""The seam to a gripper, simulated or real."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from skillc_runtime.motion.pose import Array, Pose


class Gripper(Protocol):
    """Fingers that open and close, and what they hold."""

    @property
    def max_opening_m(self) -> float:
        """Greatest distance between the fingers."""
        ...

    @property
    def max_force_n(self) -> float:
        """Greatest grasping force."""
        ...

    @property
    def opening_m(self) -> float:
        """Measured distance between the fingers."""
        ...

    @property
    def moving(self) -> bool:
        """Whether the fingers still move towards what was asked."""
        ...

    def move(self, opening_m: float, force_n: float) -> None:
        """Move the fingers to an opening with at most this force; returns at once."""
        ...

    def stop(self) -> None:
        """Keep the fingers where they are."""
        ...

    def touches(self, thing: str) -> bool:
        """Whether fingers touch a thing (its IRI) from opposite sides."""
        ...

    def attach(self, thing: str, in_tool_centre: Pose) -> None:
        """Count the thing as held from now on, its frame at `in_tool_centre` of the gripper's tool centre point.

        RuntimeError when the fingers do not touch it from both sides.
        """
        ...

    def detach(self) -> None:
        """Count nothing as held."""
        ...

    @property
    def holding(self) -> str | None:
        """The thing that counts as held; nothing as soon as the gripper feels that it has lost it."""
        ...


def working_face(size: Array) -> Pose:
    """Return the tool centre point of a tool of size (3,) m, in the tool's frame.

    The tool's frame lies in the middle of its block, z away from the working face; the tool centre point lies in the
    middle of that face, z out of the tool, x along the tool's x.
    """
    return Pose(np.array([0.0, 0.0, -size[2] / 2]), np.diag([1.0, -1.0, -1.0]))
