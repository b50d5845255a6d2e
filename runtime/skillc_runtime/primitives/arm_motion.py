"""The base class of arm motions: they succeed when the arm has arrived and fail if it does not arrive in time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar

from skillc_runtime.devices.motion_interface import Infeasible
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.primitives.computation import Computing
from skillc_runtime.primitives.compute_here import compute_here
from skillc_runtime.primitives.known_limits import find_excess, find_place_outside, find_unshareable
from skillc_runtime.primitives.place_description import describe_place
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, SpaceLacking, Status
from skillc_runtime.primitives.time_limits import STANDSTILL_S
from skillc_runtime.primitives.touch_guard import RESISTANCE_N, TouchGuard
from skillc_runtime.world.state.labels.labelled import LabelledQuantity
from skillc_runtime.world.state.terms import HAS_GRIPPER

if TYPE_CHECKING:
    from skillc_runtime.devices.arm_driver import ArmDriver
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.world.state.values import Value
    from skillc_runtime.world.state.world_state import WorldState

MAX_SETTLING_S = 1.5
"""How long after the end of its reference an arm may take to come to rest."""


class ArmMotion(Primitive):
    """A motion that `start_motion` gives to the driver of the arm.

    `targets` are the parameters of poses and paths to which the tool goes; the arm is the parameter `arm`. It stops at
    the first touch, where something resists it with more than `resistance` N, unless the arm yields along an axis.
    """

    targets: ClassVar[tuple[str, ...]] = ()
    ends_free: ClassVar[bool] = False
    """Whether it ends where nothing is touched, so that all that the arm feels there is an error of its own weight."""
    moves = NOTHING

    @classmethod
    def find_problem(cls, arguments: Mapping[str, Value], state: WorldState) -> str | None:
        """Return which target is outside the workspace, or that the tool would be faster than its arm allows."""
        too_fast = find_excess(arguments, "speed", "m/s", ("arm", "speedLimit"), state)
        too_fast = too_fast or find_unshareable(arguments, "speed", "speed", state)
        return too_fast or find_place_outside(arguments, cls.targets, "arm", state)

    def __init__(self, cell: Cell, arm: str, resistance: float = RESISTANCE_N) -> None:
        super().__init__(cell)
        self.arm: ArmDriver = cell.arm(arm)
        self._individual = arm
        self._guard = TouchGuard(cell, arm, resistance)
        self._ended: float | None = None
        self._moved_at, self._is_tared = 0.0, False

    def start(self) -> None:
        """Start to look for the motion; SkillFailure for a fault of the arm that was not reported yet."""
        raise_fault(self.arm)
        self.computing = self._begin()

    def is_near_end(self) -> bool:
        """Whether the tool is so near its end that it has arrived even if it touches something."""
        return False

    def note_touch(self) -> None:
        """Write what follows from a touch on the way to the world model."""
        self._guard.note_unknown(type(self).__name__)

    def start_motion(self) -> Computing:
        """Find the motion and give it to the arm; SkillFailure before anything moves."""
        raise NotImplementedError

    def tick(self) -> Status:
        """Return SUCCESS when the arm has arrived.

        SkillFailure for a fault, if it touches something, or if it does not arrive in time.
        """
        compute_here(self)
        if (fault := self.arm.take_fault()) is not None:
            raise SkillFailure(fault + self._describe_held())
        if (touched := self._guard.find_touch()) is not None:
            if self.is_near_end():
                return Status.SUCCESS
            self.note_touch()
            raise touched
        if not self.arm.motion.done:
            self._check_progress()
            return Status.RUNNING
        error = self.arm.motion.tracking_error_message
        if error is None:
            return Status.SUCCESS
        self._ended = self.cell.now if self._ended is None else self._ended
        if self.ends_free and not self._is_tared and self.arm.measured.link_torque is not None:
            self._tare()
            return Status.RUNNING
        if self.cell.now - self._ended > MAX_SETTLING_S:
            raise SkillFailure(error + self._describe_held())
        return Status.RUNNING

    def _begin(self) -> Computing:
        try:
            yield from self.start_motion()
        except Infeasible as why:
            raise infeasible_motion(self.cell, self.arm, why) from why
        self._moved_at = self.cell.now

    def _tare(self) -> None:
        """Let an arm with torque sensors that is wrong about its own weight feel that at rest, and then come nearer."""
        self._is_tared = self.arm.compliance.tare()
        if self._is_tared:
            self._ended = self.cell.now

    def _describe_held(self) -> str:
        """Return what the arm's grippers hold, as the end of a sentence; empty for nothing."""
        state = self.cell.world.snapshot()
        grippers = {each: self.cell.gripper(each) for each in sorted(state.objects(self._individual, HAS_GRIPPER))}
        held = {hand: gripper.holding for hand, gripper in grippers.items() if gripper.holding is not None}
        short = state.vocabulary.short
        return "".join(f", while {short(hand)} holds {short(thing)}" for hand, thing in held.items())

    def _check_progress(self) -> None:
        """Raise SkillFailure if the motion has not ended and stands still for too long."""
        now = self.cell.now
        if not self.arm.motion.stationary:
            self._moved_at = now
        elif now - self._moved_at > STANDSTILL_S:
            standing = LabelledQuantity(STANDSTILL_S, "s")
            raise SkillFailure("the arm has stood still for {standing} before the end of its motion", standing=standing)

    def halt(self, reason: str) -> None:
        """Stop the arm, and note what resists it: its limits may have stopped it before `tick` has felt a touch."""
        if self._guard.feel_touch() is not None and not self.is_near_end():
            self.note_touch()
        self.arm.motion.stop()

    def pause(self) -> None:
        """Slow down to standstill."""
        self.arm.motion.pause()

    def resume(self) -> None:
        """Continue the motion."""
        self.arm.motion.resume()

    def limits(self, speed: float) -> MotionLimits:
        """Return the limits of a tool motion at a speed in m/s; SkillFailure if the arm allows less."""
        if speed > self.arm.task_limits.speed_m_s:
            raise SkillFailure(
                "{speed} is faster than the {limit} the arm allows",
                speed=LabelledQuantity(speed, "m/s"),
                limit=LabelledQuantity(self.arm.task_limits.speed_m_s, "m/s"),
            )
        return MotionLimits(speed, self.arm.task_limits.acceleration_m_s2, jerk=self.arm.task_limits.jerk_m_s3)


def infeasible_motion(cell: Cell, arm: ArmDriver, why: Infeasible) -> SpaceLacking:
    """Return the failure of a motion that the arm cannot follow, with the place in the world frame."""
    place = describe_place(cell.world.snapshot(), arm.measured.in_world(why.place))
    return SpaceLacking(f"the motion does not fit the arm: {why.problem}, at {place}")


def raise_fault(arm: ArmDriver) -> None:
    """Raise SkillFailure if the driver stopped because of a fault; each fault is reported once."""
    fault = arm.take_fault()
    if fault is not None:
        raise SkillFailure(fault)
