"""Compliance of an arm: releasing an axis, pushing, aligning with a surface."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from math import inf
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from skillc_runtime.devices.guarded_push import GuardedPush, MeasuredForce, PushProgress, Travel
from skillc_runtime.motion.pose import Array, log
from skillc_runtime.primitives.approach_speed import find_greatest_approach
from skillc_runtime.primitives.arm_motion import raise_fault
from skillc_runtime.primitives.drift_report import report_drift
from skillc_runtime.primitives.known_limits import find_excess, find_unshareable
from skillc_runtime.primitives.primitive import NOTHING, Activity, Primitive, SkillFailure, Status
from skillc_runtime.primitives.push_force import write_push_force
from skillc_runtime.primitives.space_needs import Press, SpaceNeed
from skillc_runtime.primitives.surface_location import write_surface_pose
from skillc_runtime.primitives.time_limits import approach_limit_s
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.labels.labelled import LabelledQuantity
from skillc_runtime.world.state.terms import APPROACH_SPEED

if TYPE_CHECKING:
    from skillc_runtime.devices.arm_driver import ArmDriver
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.world.state.values import Value
    from skillc_runtime.world.state.world_state import WorldState

APPROACH_M_S = 0.05
"""Speed of the approach to a surface whose position is uncertain."""

RAMP_S = 0.4
"""Time in which the push force is reached and the tool comes to rest."""

SETTLING_S = 0.3
"""Time after aligning in which springs and reference settle."""

FLUSH_RAD, FLUSH_S = 0.0008, 2.0
"""A tool is flush if its mean orientations in the two halves of FLUSH_S differ by less than FLUSH_RAD."""

MIN_ALIGN_S = 2.5
"""Before this time, a tool that hardly turns may only be starting to turn."""


def yield_along(arm: ArmDriver, along: Array, stiffness: float) -> None:
    """Let an arm yield along a direction (3,) in the world with a stiffness in N/m; SkillFailure if it cannot."""
    try:
        arm.compliance.release(along, stiffness)
    except ValueError as refusal:
        raise SkillFailure(str(refusal)) from refusal


class ReleaseAxis(Primitive):
    """Makes the arm compliant along `along` (3,) with `stiffness` N/m until the scope ends."""

    moves = NOTHING
    stays_put = True

    def __init__(self, cell: Cell, *, arm: str, along: Array, stiffness: float) -> None:
        super().__init__(cell)
        self.arm, self._arm = cell.arm(arm), arm
        self._along, self._stiffness, self._released = along, stiffness, False

    def start(self) -> None:
        """Release the axis, once the force sensor is tared; the tool does not move."""
        raise_fault(self.arm)
        self._try_to_release()

    def tick(self) -> Status:
        """Return SUCCESS once the axis is released."""
        if not self._released:
            raise_fault(self.arm)
            self._try_to_release()
        return Status.SUCCESS if self._released else Status.RUNNING

    def release(self) -> None:
        """Make the axis stiff again at the current position."""
        if self._released:
            self.arm.compliance.restore()

    def _try_to_release(self) -> None:
        if self.arm.compliance.tare():
            raise_fault(self.arm)
            yield_along(self.arm, self._along, self._stiffness)
            self._released = True
            report_drift(self.cell, self._arm, "ReleaseAxis")

    def pause(self) -> None:
        """Hold the tool along the axis, unless it presses on something."""
        self.arm.compliance.pause()

    def resume(self) -> None:
        """Yield again."""
        self.arm.compliance.resume()


class Push(Primitive):
    """Approaches a surface opposite to `along` (3,) at `approach` m/s, then presses on it with `force` N in the scope.

    It approaches no faster than the pad of the tool allows, see `approach_speed`. If contact is lost, at a hole or an
    edge, the tool approaches again. Fails if there is no contact within `travel` m;
    stops the arm if the tool later sinks by as much.
    """

    activity: ClassVar[Activity] = "press"
    moves = NOTHING

    @classmethod
    def find_problem(cls, arguments: Mapping[str, Value], state: WorldState) -> str | None:
        """Return that the force is more than the arm allows, or people whom it may meet."""
        too_hard = find_excess(arguments, "force", "N", ("arm", "forceLimit"), state)
        return too_hard or find_unshareable(arguments, "force", "force", state)

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return that the tool presses."""
        arm, along, force = arguments.get("arm"), arguments.get("along"), arguments.get("force")
        if not isinstance(arm, str) or not isinstance(along, np.ndarray) or not isinstance(force, float):
            return None
        return (Press(arm, -force * along),)

    def __init__(
        self, cell: Cell, *, arm: str, along: Array, force: float, travel: float, approach: float = APPROACH_M_S
    ) -> None:
        super().__init__(cell)
        self.arm, self._arm = cell.arm(arm), arm
        fastest = find_greatest_approach(cell.world.snapshot(), arm, force)
        self._push = GuardedPush(along, force, min(approach, fastest), Travel(travel))
        self._is_slowed = fastest < approach
        self._progress: PushProgress | None = None
        self._taken_off, self._has_pressed, self._ends = False, False, 0.0

    @property
    def is_pressing(self) -> bool:
        """Whether the tool is in contact."""
        return self._progress is not None and self._progress.pressed_s is not None

    def start(self) -> None:
        """Begin the approach."""
        raise_fault(self.arm)
        compliance, greatest_n = self.arm.compliance, self.arm.task_limits.force_n
        if not compliance.yields_along(self._push.along):
            raise SkillFailure(
                "the arm must yield along the direction in which it shall push; use it within Compliance"
            )
        if self._push.force_n > greatest_n:
            raise SkillFailure(
                "{force} is more than the {limit} the arm allows",
                force=LabelledQuantity(self._push.force_n, "N"),
                limit=LabelledQuantity(greatest_n, "N"),
            )
        if self._push.approach_m_s <= 0.0:
            raise SkillFailure("a tool approaches with more than 0 m/s, else it touches nothing")
        self._ends = self.cell.now + approach_limit_s(
            self._push.travel.distance_m, self._push.approach_m_s * self.arm.speed
        )
        if self._is_slowed:
            slowed = SetProperty(self._arm, APPROACH_SPEED, self._push.approach_m_s)
            self.cell.world.commit([slowed], "Push", "reported")
        self._progress = compliance.start_push(self._push)

    def tick(self) -> Status:
        """Return SUCCESS once the tool presses with the force; SkillFailure if it does not touch anything in time."""
        raise_fault(self.arm)
        if self._presses():
            self._has_pressed = True
            return Status.SUCCESS
        if self.cell.now > self._ends:
            raise SkillFailure("the tool neither touches anything nor gets anywhere: it does not come to rest")
        return Status.RUNNING

    def release(self) -> None:
        """Stop pushing, and note with which force the arm pushed."""
        if self._progress is None:
            return
        self.arm.compliance.end_push(self._progress)
        if self._has_pressed and self._push.force_n > 0.0:
            self.note_force(self._progress.force)

    def note_force(self, measured: MeasuredForce) -> None:
        """Write with which force the arm pushed: sensed if that was measured."""
        write_push_force(self.cell.world, self._arm, self._push.force_n, measured)

    def pause(self) -> None:
        """Stop approaching; a tool in contact goes on pressing."""
        self.arm.compliance.pause()

    def withdraw(self) -> None:
        """Take the tool off, if it presses."""
        if self._progress is not None:
            self._taken_off = self._taken_off or self.is_pressing
            self.arm.compliance.withdraw(self._progress)

    def approach(self) -> bool:
        """Approach again; return whether the tool presses with the force, if it did before."""
        self.arm.compliance.resume()
        return not self._taken_off or self._presses()

    def resume(self) -> None:
        """Go on approaching, if the tool had not touched anything yet."""
        self._taken_off = False
        self.arm.compliance.resume()

    def _presses(self) -> bool:
        pressed_s = None if self._progress is None else self._progress.pressed_s
        return pressed_s is not None and pressed_s >= RAMP_S


class Align(Primitive):
    """Lets the pushed tool turn for at most `settle` s until it is flush with `surface`; writes the surface's pose.

    A tool that yields is turned by a few hundredths of 1 N m. So an arm that feels forces is tared before, just off the
    surface: what it gets wrong of its own weight differs between here and where its approach began.
    """

    moves = NOTHING
    stays_put = True

    def __init__(self, cell: Cell, *, arm: str, surface: str, settle: float) -> None:
        super().__init__(cell)
        self.arm, self._arm = cell.arm(arm), arm
        self._surface, self._settle = surface, settle
        self._began, self._held_at = 0.0, inf
        self._from = np.eye(3)
        self._turned: Array = np.zeros(3)
        self._sums: deque[tuple[float, Array]] = deque()
        """Times, and at each the sum of all turns (3,) in rad before it."""
        self._is_tared = False

    def start(self) -> None:
        """Release the rotation of the tool."""
        raise_fault(self.arm)
        self._is_tared = False
        self._try_to_release()

    def tick(self) -> Status:
        """Return SUCCESS when the tool is flush, its rotation is stiff again, and the surface's pose is written."""
        raise_fault(self.arm)
        now = self.cell.now
        if not self._is_tared:
            self._try_to_release()
            return Status.RUNNING
        if self._held_at == inf and (now - self._began >= self._settle or self._is_flush(now)):
            self._hold()
        if now < self._held_at + SETTLING_S:
            return Status.RUNNING
        write_surface_pose(self.cell.world, self._surface, self.arm.measured.pose)
        return Status.SUCCESS

    def halt(self, reason: str) -> None:
        """Make the rotation of the tool stiff again."""
        if self._yields:
            self._hold()

    def pause(self) -> None:
        """Hold the rotation of the tool."""
        if self._yields:
            self.arm.compliance.restore_rotation()

    def resume(self) -> None:
        """Release the rotation again, for as long as at the start."""
        if self._yields:
            self._release()

    @property
    def _yields(self) -> bool:
        """Whether the rotation of the tool is released."""
        return self._is_tared and self._held_at == inf

    def _try_to_release(self) -> None:
        self._is_tared = self.arm.compliance.retare()
        if self._is_tared:
            raise_fault(self.arm)
            report_drift(self.cell, self._arm, "Align")
            self._from = self.arm.measured.pose.rotation
            self._release()

    def _release(self) -> None:
        """Release the rotation of the tool, from now on."""
        self._began = self.cell.now
        self._sums.clear()
        self.arm.compliance.release_rotation()

    def _is_flush(self, now: float) -> bool:
        """Whether the tool has come to rest on the surface: it has hardly turned for a while."""
        self._sums.append((now, self._turned))
        self._turned = self._turned + log(self.arm.measured.pose.rotation @ self._from.T)
        while now - self._sums[0][0] > FLUSH_S:
            self._sums.popleft()
        if now - self._began < MIN_ALIGN_S:
            return False
        count = len(self._sums)
        half = count // 2
        first, middle = self._sums[0][1], self._sums[half][1]
        turned = (self._turned - middle) / (count - half) - (middle - first) / half
        return bool(np.linalg.norm(turned) < FLUSH_RAD)

    def _hold(self) -> None:
        self._held_at = self.cell.now
        self.arm.compliance.restore_rotation()
