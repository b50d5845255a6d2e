"""What all motions of an arm have in common: they end when the arm is there, and fail when it does not come."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.devices.arm_driver import Infeasible
from skillc_runtime.motion.segments import MotionLimits
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.primitives.whereabouts import whereabouts

if TYPE_CHECKING:
    from skillc_runtime.devices.arm_driver import ArmDriver
    from skillc_runtime.devices.cell import Cell

PATIENCE_S = 1.5
"""How long after its reference an arm may come to rest."""


class ArmMotion(Primitive):
    """A motion that `go` gives to the arm's driver; the rest of its life is alike for all."""

    def __init__(self, cell: Cell, arm: str) -> None:
        super().__init__(cell)
        self.arm: ArmDriver = cell.arm(arm)
        self._ended: float | None = None

    def start(self) -> None:
        """Go, unless the arm has a fault that nobody has been told of yet."""
        raise_fault(self.arm)
        try:
            self.go()
        except Infeasible as why:
            raise unfit(self.cell, self.arm, why) from why

    def go(self) -> None:
        """Give the motion to the arm; SkillFailure before anything moves."""
        raise NotImplementedError

    def tick(self) -> Status:
        """Return SUCCESS once the arm is there."""
        raise_fault(self.arm)
        if not self.arm.motion.done:
            return Status.RUNNING
        error = self.arm.motion.tracking_error_message
        if error is None:
            return Status.SUCCESS
        self._ended = self.cell.now if self._ended is None else self._ended
        if self.cell.now - self._ended > PATIENCE_S:
            raise SkillFailure(error)
        return Status.RUNNING

    def halt(self, reason: str) -> None:
        """Come to rest."""
        self.arm.motion.stop()

    def pause(self) -> None:
        """Slow down to a standstill."""
        self.arm.motion.pause()

    def resume(self) -> None:
        """Go on."""
        self.arm.motion.resume()

    def limits(self, speed: float) -> MotionLimits:
        """Return the limits of a motion of the tool with a speed in m/s; SkillFailure where the arm allows less."""
        if speed > self.arm.task_limits.speed_m_s:
            raise SkillFailure(
                f"{speed:g} m/s is faster than the {self.arm.task_limits.speed_m_s:g} m/s the arm allows"
            )
        return MotionLimits(speed, self.arm.task_limits.acceleration_m_s2, jerk=self.arm.task_limits.jerk_m_s3)


def unfit(cell: Cell, arm: ArmDriver, why: Infeasible) -> SkillFailure:
    """Return the failure that says which motion does not fit the arm, and where."""
    place = whereabouts(cell.world.snapshot(), arm.measured.in_world(why.place))
    return SkillFailure(f"the motion does not fit the arm: {why.problem}, at {place}")


def raise_fault(arm: ArmDriver) -> None:
    """Fail with what made the driver stop, once."""
    fault = arm.take_fault()
    if fault is not None:
        raise SkillFailure(fault)
