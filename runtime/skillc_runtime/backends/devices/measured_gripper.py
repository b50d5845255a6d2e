"""What the drivers of grippers share: limits by the facts, and what counts as held by the measured opening."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from skillc_runtime.backends.simulation.scene_spec import GripperSpec
from skillc_runtime.devices.gripper import Gripper, has_closed_further
from skillc_runtime.motion.pose import Pose

Hold: TypeAlias = Callable[[str, Pose, float, float], None]
"""Reports to an arm what its hand holds: IRI, pose in the tool centre point of the empty hand, mass in kg, and how far
the fingers are open, in m."""


class MeasuredGripper(Gripper):
    """A gripper that measures its opening; subclasses move it. `hold` and `let_go` report to the arm what it holds."""

    def __init__(self, name: str, facts: GripperSpec, hold: Hold, let_go: Callable[[], None]) -> None:
        """Hold nothing; `name` is for messages."""
        self._name, self._facts, self._hold, self._let_go = name, facts, hold, let_go
        self._held: tuple[str, float] | None = None

    @property
    def max_opening_m(self) -> float:
        """The greatest distance between the fingers in m."""
        return self._facts.max_opening_m

    @property
    def max_force_n(self) -> float:
        """The greatest grasping force in N."""
        return self._facts.max_force_n

    @property
    def opening_error_m(self) -> float:
        """The greatest error of the measured opening in m."""
        return self._facts.opening_error_m

    def attach(self, thing: str, in_tool_centre: Pose, mass_kg: float) -> None:
        """Count an object as held; RuntimeError if the fingers are not blocked, or the scene has no body of it."""
        if not self.blocked:
            raise RuntimeError(f"nothing keeps the fingers of {self._name} from closing")
        opening_m = self.opening_m
        self._hold(thing, in_tool_centre, mass_kg, opening_m)
        self._held = thing, opening_m

    def detach(self) -> None:
        """Count nothing as held."""
        if self._held is not None:
            self._held = None
            self._let_go()

    @property
    def holding(self) -> str | None:
        """The IRI of the object that counts as held; None as soon as the fingers close further: it was lost."""
        if self._held is None:
            return None
        thing, held_at_m = self._held
        return None if has_closed_further(self.opening_m, held_at_m) else thing
