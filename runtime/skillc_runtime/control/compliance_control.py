"""Compliance of one arm for skills: releasing axes and pushing."""

from __future__ import annotations

from math import inf

import numpy as np
from msgspec.structs import replace

from skillc_runtime.control import push_memory
from skillc_runtime.control.arm_task import ArmTask
from skillc_runtime.control.compliance_state import STIFFNESS
from skillc_runtime.control.guarded_push import ActivePush
from skillc_runtime.control.push_memory import FALL_SHARE, MOST_PUSHES, SETTLED_S, SIZE
from skillc_runtime.devices.guarded_push import GuardedPush, PushProgress
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.reference import ROTATION

LIFT_M = 0.02
"""How far a tool is taken off what it presses on; half the travel of its push where that is less."""

RETARE_M = 0.01
"""The same to tare near the surface: more than 5 deg of tilt and a pad that is pressed in need."""


class ComplianceControl:
    """Implements `ComplianceInterface`; directions (3,) are unit vectors in the world frame.

    release_damping N s/m: force per speed of a released axis. pushes (n, m): a row for each active push.
    """

    def __init__(self, task: ArmTask, release_damping: float) -> None:
        self._task, self._release_damping = task, release_damping
        self.active_pushes: tuple[ActivePush, ...] = ()
        self.pushes: Array = np.zeros((MOST_PUSHES, SIZE))
        self._paused = self._retares = False

    @property
    def commanded_stiffness(self) -> Array:
        """The commanded stiffness (6,) along the axes of the compliance frame, N/m and N m/rad."""
        return self._task.tool.compliance.wanted.stiffness.copy()

    @property
    def live_stiffness(self) -> Array:
        """The same (6,), but that of the gains along axes that are held meanwhile; not a copy."""
        live: Array = self._task.tool.compliance.memory.target[STIFFNESS]
        return live

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

    def tare(self) -> bool:
        """Let what the force sensor feels of nothing be 0; return whether nothing is left to be waited for."""
        return self.released or self._task.taring.tare(self._task.now)

    @property
    def tares(self) -> bool:
        """Whether the arm feels forces that `tare` lets be 0."""
        return self._task.taring.is_possible

    @property
    def force_drift(self) -> float:
        """How fast the force of the sensor was found to drift by its tares, in N/s, which is taken off; 0 without."""
        return self._task.taring.force_drift

    def retare(self) -> bool:
        """Take the tool off what it presses on, tare there, and press again; return whether it does."""
        tool, taring, now = self._task.tool, self._task.taring, self._task.now
        if not self._retares:
            self._retares = self.tares and self._in_contact
            if self._retares:
                pressing = [each for each in self.active_pushes if each.pressed_s is not None]
                self._hold()
                for each in pressing:
                    self._lift(each.push, RETARE_M)
        elif tool.compliance.held:
            if not tool.lifting(now) and taring.tare(now, has_touched=True):
                self._approach_again()
        else:
            self._retares = any((each.pressed_s or 0.0) < SETTLED_S for each in self.active_pushes)
        return not self._retares

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
        """Push opposite to an axis, which must be released; ValueError if it is not.

        The tool is braked if it moves faster than `fastest_m_s` in the direction of the push, for whatever reason.
        axis: (3,), a unit vector in the world.
        force_n: N.
        fastest_m_s: m/s.
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
        active = ActivePush(push, self._task.measured.in_base(push.along), self._free_row())
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
            self._approach_again()
        self._paused = False

    def act(self) -> str | None:
        """Do what pushes need after a control period; return why the arm must stop, or None."""
        reason = None
        for active in self.active_pushes:
            travel_cm = 100 * active.push.travel.distance_m
            match active.action:
                case push_memory.APPROACH if self._paused:
                    self._hold()
                case push_memory.APPROACH:
                    self._approach(active.push)
                case push_memory.PRESS:
                    self._press(active.push, active.push.force_n)
                case push_memory.NO_CONTACT:
                    self._forget(active)
                    reason = f"nothing to push against within {travel_cm:.0f} cm"
                case push_memory.SANK:
                    self._forget(active)
                    reason = f"contact was lost: the tool sank by {travel_cm:.0f} cm"
        return reason

    def abandon(self) -> None:
        """Abandon all pushes and hold the tool along released axes, for an arm that stops by itself."""
        self._forget_all()
        self.push_off()
        self._hold()

    def secure(self) -> bool:
        """Stop pushing and restore all releases; tell whether any were left."""
        self._forget_all()
        self._paused = False
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

    def _approach_again(self) -> None:
        """Yield again after `_hold`, and let all pushes approach."""
        self._let_go()
        for active in self.active_pushes:
            active.approach()
            self._approach(active.push)

    def _lift(self, push: GuardedPush, farthest_m: float = LIFT_M) -> None:
        way = min(farthest_m, push.travel.distance_m / 2) * self._task.measured.in_base(push.along)
        self._task.tool.lift(way, push.approach_m_s, self._task.now)

    def _free_row(self) -> Array:
        """Return a row for another push; ValueError if there is none."""
        for row in self.pushes:
            if row[push_memory.PHASE] == push_memory.NO_PUSH:
                free: Array = row
                return free
        raise ValueError(f"an arm pushes in at most {MOST_PUSHES} ways at once")

    def _forget(self, push: PushProgress) -> None:
        for each in self.active_pushes:
            if each is push:
                each.end()
        self.active_pushes = tuple(each for each in self.active_pushes if each is not push)

    def _forget_all(self) -> None:
        for each in self.active_pushes:
            each.end()
        self.active_pushes, self._retares = (), False

    def _approach(self, push: GuardedPush) -> None:
        """Push just hard enough to move the tool with the approach speed."""
        self._press(push, push.approach_m_s * self._release_damping)

    def _press(self, push: GuardedPush, force_n: float) -> None:
        """Push, with the speed of the tool limited so that it does not hit a surface much faster than it approaches."""
        self.push(push.along, force_n, FALL_SHARE * push.approach_m_s)

    def _in_tool(self, direction: Array) -> Array:
        """Return a direction (3,) of the world in the reference tool frame."""
        return self._task.tool.in_tool(self._task.measured.in_base(direction), self._task.now)
