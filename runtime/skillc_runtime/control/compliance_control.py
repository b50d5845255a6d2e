"""Compliance of one arm for skills: releasing axes and pushing."""

from __future__ import annotations

from dataclasses import replace
from math import inf
from typing import assert_never

import numpy as np

from skillc_runtime.control.arm_task import ArmTask
from skillc_runtime.control.guarded_push import FALL_SHARE, ActivePush, GivenUp
from skillc_runtime.devices.arm import ArmState
from skillc_runtime.devices.guarded_push import GuardedPush, PushProgress
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.reference import ROTATION

LIFT_M = 0.02
"""How far a tool is taken off what it presses on; half the travel of its push where that is less."""


class ComplianceControl:
    """Implements `ComplianceInterface`; directions (3,) are unit vectors in the world frame.

    release_damping N s/m: force per speed of a released axis.
    """

    def __init__(self, task: ArmTask, release_damping: float) -> None:
        self._task, self._release_damping = task, release_damping
        self.active_pushes: tuple[ActivePush, ...] = ()
        self._paused = False

    @property
    def commanded_stiffness(self) -> Array:
        """The commanded stiffness (6,) along the axes of the compliance frame, N/m and N m/rad."""
        return self._task.tool.compliance.wanted.stiffness.copy()

    @property
    def commanded_wrench(self) -> Array:
        """The commanded wrench (6,) along the axes of the compliance frame, N and N m."""
        return np.concatenate([self._task.tool.compliance.wanted.force, np.zeros(3)])

    @property
    def commanded_force(self) -> Array:
        """The force (3,) N on the tool by what it presses on, world axes, that is commanded now; NaN without a push.

        It follows that of `commanded_wrench`, which is the end of the ramp.
        """
        task, exerted = self._task, self._task.tool.compliance.exerted
        if task.joints is not None or not exerted.any():
            return np.full(3, np.nan)
        return -(task.base().rotation @ task.tool.reference.rows[ROTATION] @ exerted)

    @property
    def live_force(self) -> Array:
        """The force (3,) N that the tool is to exert, along the axes of its reference; not a copy. 0 without a push."""
        return self._task.tool.compliance.exerted

    @property
    def pushing(self) -> bool:
        """Whether the tool pushes, or its last push has not faded out yet."""
        return self._task.tool.compliance.pushing

    @property
    def _in_contact(self) -> bool:
        return any(push.pressed_s is not None for push in self.active_pushes)

    def release(self, axis: Array, stiffness: float = 0.0) -> None:
        """Release a direction (3,), which then moves with the reference tool frame; stiffness in N/m.

        Without a push the tool does not move; pushed with F it moves with about F / release damping. Raises ValueError
        for a nested release that is neither parallel nor perpendicular to the first.
        """
        self._let_go()
        self._task.move_tool().compliance.release(self._in_tool(axis), stiffness)

    def restore(self) -> None:
        """Undo the last release: hold the tool, along the released axis, where it is now. Abandons a motion."""
        if self._task.joints is not None:
            self._task.tool.compliance.restore(np.zeros(3))
        else:
            self._task.tool.restore(self._task.now)

    @property
    def released(self) -> bool:
        """Whether any direction is released."""
        return self._task.tool.compliance.released

    def yields_along(self, axis: Array) -> bool:
        """Tell whether a direction (3,) is released."""
        return self._task.joints is None and self._task.tool.compliance.yields(self._in_tool(axis))

    def release_rotation(self) -> None:
        """Release the rotations about the two axes perpendicular to the released one."""
        self._task.move_tool().compliance.set_rotation_free(True)

    def restore_rotation(self) -> None:
        """Hold the present rotation of the tool. Abandons a motion."""
        if self._task.joints is not None:
            self._task.tool.compliance.set_rotation_free(False)
        else:
            self._task.tool.restore_rotation(self._task.now)

    def push(self, axis: Array, force_n: float, fastest_m_s: float = inf) -> None:
        """Push opposite to `axis` (3,), which must be released; ValueError if it is not.

        The tool is braked if it moves faster than `fastest_m_s` in the direction of the push, for whatever reason.
        """
        self._let_go()
        tool = self._task.move_tool()
        tool.push(-self._task.measured.in_base(axis), force_n, fastest_m_s, self._task.now)

    def push_off(self) -> None:
        """Fade the push out."""
        self._task.tool.compliance.push_off()

    def start_push(self, push: GuardedPush) -> ActivePush:
        """Begin to approach and then to push; the result gives the progress."""
        push = replace(push, approach_m_s=push.approach_m_s * self._task.speed)
        active = ActivePush(push, self._task.measured.in_base(push.along), self._task.measured.felt_wrench)
        self._approach(push)
        self.active_pushes = (*self.active_pushes, active)
        return active

    def end_push(self, push: PushProgress) -> None:
        """Stop pushing."""
        self._forget(push)
        self.push_off()

    def pause(self) -> None:
        """Hold the tool along released axes, unless a push is in contact; it is held if that loses contact."""
        self._paused = True
        if not self._in_contact:
            self._hold()

    def withdraw(self, push: PushProgress) -> None:
        """Take the tool off what it presses on, with its approach speed, and hold it there."""
        self._paused, in_contact = True, self._in_contact
        self._hold()
        for active in self.active_pushes:
            if active is push and in_contact:
                self._lift(active.push)

    def resume(self) -> None:
        """Yield again as before `pause` or `withdraw`; a push that was held approaches again.

        While the tool is still being taken off, this does nothing; it is to be called again.
        """
        tool, now = self._task.tool, self._task.now
        if tool.compliance.held:
            if tool.lifting(now):
                return
            self._let_go()
            for active in self.active_pushes:
                active.approach()
                self._approach(active.push)
        self._paused = False

    def evaluate(self, active: ActivePush, state: ArmState) -> str | None:
        """Advance a push by a control period; return why it was abandoned and the arm must stop, or None."""
        match active.step(state, self._task.contact_wrench, self._task.period):
            case "approach" if self._paused:
                self._hold()
            case "approach":
                self._approach(active.push)
            case "press":
                self._press(active.push, active.push.force_n)
            case "go on":
                pass
            case GivenUp(reason=reason):
                self._forget(active)
                return reason
            case never:
                assert_never(never)
        return None

    def abandon(self) -> None:
        """Abandon all pushes and hold the tool along released axes, for an arm that stops by itself."""
        self.active_pushes = ()
        self.push_off()
        self._hold()

    def secure(self) -> bool:
        """Stop pushing and restore all releases; tell whether any were left."""
        self.active_pushes, self._paused = (), False
        compliance, left = self._task.tool.compliance, not self._task.tool.compliance.stiff
        while compliance.released:
            self.restore()
        if not compliance.stiff:
            self.restore_rotation()
        return left

    def _hold(self) -> None:
        """Hold the tool along released axes, and all pushes."""
        if self._task.joints is not None or not self._task.tool.compliance.released or self._task.tool.compliance.held:
            return
        self._task.tool.hold_released(self._task.now)
        for active in self.active_pushes:
            active.hold()

    def _let_go(self) -> None:
        """Let released axes yield, if they are held."""
        if self._task.tool.compliance.held:
            self._task.tool.let_go_released(self._task.now)

    def _lift(self, push: GuardedPush) -> None:
        way = min(LIFT_M, push.travel.distance_m / 2) * self._task.measured.in_base(push.along)
        self._task.tool.lift(way, push.approach_m_s, self._task.now)

    def _forget(self, push: PushProgress) -> None:
        self.active_pushes = tuple(each for each in self.active_pushes if each is not push)

    def _approach(self, push: GuardedPush) -> None:
        """Push just hard enough to move the tool with the approach speed."""
        self._press(push, push.approach_m_s * self._release_damping)

    def _press(self, push: GuardedPush, force_n: float) -> None:
        """Push, with the speed of the tool limited so that it does not hit a surface much faster than it approaches."""
        self.push(push.along, force_n, FALL_SHARE * push.approach_m_s)

    def _in_tool(self, direction: Array) -> Array:
        """Return a direction (3,) of the world in the reference tool frame."""
        return self._task.tool.in_tool(self._task.measured.in_base(direction), self._task.now)
