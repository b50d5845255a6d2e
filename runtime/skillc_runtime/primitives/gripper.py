"""Moving the fingers of a gripper: one class for each kind of gripper, since they take their commands differently."""

from __future__ import annotations

from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.robots.cell import Cell
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of

TOLERANCE_M = 0.003


class ParallelGripper(Primitive):
    """Two parallel fingers: opening and force are taken as they are."""

    def __init__(self, cell: Cell, *, gripper: str, opening: float, force: float) -> None:
        super().__init__(cell)
        self._gripper = cell.gripper(gripper)
        self._name, self._opening, self._force = gripper, opening, force

    def start(self) -> None:
        """Begin to move; SkillFailure when the fingers cannot open so far."""
        if self._opening > self._gripper.max_opening_m + TOLERANCE_M:
            raise SkillFailure(
                f"{self._name} opens to {1000 * self._gripper.max_opening_m:.0f} mm, "
                f"not to {1000 * self._opening:.0f} mm"
            )
        self._gripper.move(*self.command())

    def command(self) -> tuple[float, float]:
        """Return the opening in m and the force in N that the gripper is asked for."""
        return self._opening, self._force

    def tick(self) -> Status:
        """Wait until the fingers rest; SkillFailure when they did not open as far as asked."""
        if self._gripper.moving:
            return Status.RUNNING
        opening = self._gripper.opening_m
        if opening < self._opening - TOLERANCE_M:
            raise SkillFailure(
                f"{self._name} is {1000 * opening:.0f} mm open, not {1000 * self._opening:.0f} mm: "
                "something is in the way"
            )
        return Status.SUCCESS

    def halt(self, reason: str) -> None:
        """Keep the fingers where they are."""
        self._gripper.stop()

    def pause(self) -> None:
        """Keep the fingers where they are."""
        self._gripper.stop()

    def resume(self) -> None:
        """Go on."""
        self._gripper.move(*self.command())


class ThreeFingerGripper(ParallelGripper):
    """Three coupled fingers, whose controller takes opening and force in equal steps up to their greatest values."""

    def start(self) -> None:
        """Look up the steps and begin to move; SkillFailure when the data sheet does not tell them."""
        try:
            self._steps = sheet_of(self.cell.world.snapshot(), self._name).number("commandSteps")
        except SheetError as error:
            raise SkillFailure(str(error)) from error
        super().start()

    def command(self) -> tuple[float, float]:
        """Return what the nearest steps mean: opening in m, force in N."""
        largest, strongest = self._gripper.max_opening_m, self._gripper.max_force_n
        return self._stepped(self._opening, largest), self._stepped(self._force, strongest)

    def _stepped(self, value: float, greatest: float) -> float:
        return min(round(value / greatest * self._steps), self._steps) * greatest / self._steps
