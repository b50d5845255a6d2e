"""The interface of a gripper, simulated or real."""

from __future__ import annotations

from typing import Protocol

from skillc_runtime.devices.arm import ArmLoad, NotOffered
from skillc_runtime.motion.pose import Array, Pose


class Gripper(Protocol):
    """Fingers that open and close, what they measure, and the object that counts as held.

    A gripper measures how far its fingers are apart and whether they are blocked. It cannot tell which object that is.
    A class that is derived from this one has what is implemented here: what a gripper may lack.
    """

    @property
    def max_opening_m(self) -> float:
        """The greatest distance between the fingers in m."""
        ...

    @property
    def max_force_n(self) -> float:
        """The greatest grasping force in N."""
        ...

    @property
    def opening_m(self) -> float:
        """The measured distance between the fingers in m."""
        ...

    @property
    def moving(self) -> bool:
        """Whether the fingers still move towards the commanded opening."""
        ...

    def move(self, opening_m: float, force_n: float) -> None:
        """Move the fingers to an opening in m with at most a force in N; returns at once."""
        ...

    def stop(self) -> None:
        """Stop the fingers at their present opening."""
        ...

    @property
    def opening_error_m(self) -> float:
        """The greatest error of the measured opening in m."""
        ...

    @property
    def blocked(self) -> bool:
        """Whether something keeps the fingers from closing: at rest, they press with the force that they were given."""
        ...

    def attach(self, thing: str, in_tool_centre: Pose, mass_kg: float) -> None:
        """Count an object as held, its frame at `in_tool_centre` in the frame of the gripper's tool centre point.

        Its mass, as far as it is known, is the arm's payload. It counts until `detach`, or until the fingers close by
        `CLOSED_FURTHER_M`.

        Raises RuntimeError if the fingers are not blocked.
        """
        ...

    def detach(self) -> None:
        """Count nothing as held."""
        ...

    @property
    def load(self) -> ArmLoad | None:
        """What the arm counts as its payload; None for nothing. NotOffered by a driver that does not tell."""
        raise NotOffered("the driver of the gripper does not tell what the arm counts as its payload")

    def correct_load(self, mass_kg: float, centre: Array) -> None:
        """Let the arm count what is held with this mass in kg, centre of mass (3,) in m in its own frame; NotOffered.

        RuntimeError if nothing counts as held.
        """
        raise NotOffered("the driver of the gripper does not correct the payload of the arm")

    @property
    def holding(self) -> str | None:
        """The IRI of the object that counts as held; None as soon as the fingers close further: it was lost."""
        ...


CLOSED_FURTHER_M = 0.003
"""How much further the fingers close, from where an object counted as held, when it is lost."""


def has_closed_further(opening_m: float, held_at_m: float) -> bool:
    """Return whether fingers, which held an object at an opening in m, have closed so far that it is lost.

    Those of a thing thinner than twice `CLOSED_FURTHER_M` close by half of it.
    """
    return opening_m < held_at_m - min(CLOSED_FURTHER_M, held_at_m / 2)
