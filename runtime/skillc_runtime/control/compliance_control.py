"""Letting the tool of one arm yield, and pushing with it, for skills."""

from __future__ import annotations

from math import inf
from typing import assert_never

import numpy as np

from skillc_runtime.control.arm_task import ArmTask
from skillc_runtime.control.guarded_push import FALL_SHARE, ActivePush, GivenUp
from skillc_runtime.devices.arm import ArmState
from skillc_runtime.devices.arm_driver import GuardedPush, PushProgress
from skillc_runtime.motion.pose import Array


class ComplianceControl:
    """Implements `ComplianceInterface`; directions (3,) are in world axes.

    release_damping N s/m: force per speed with which a released axis moves when it is pushed.
    """

    def __init__(self, task: ArmTask, release_damping: float) -> None:
        self._task, self._release_damping = task, release_damping
        self.active_pushes: tuple[ActivePush, ...] = ()

    @property
    def commanded_stiffness(self) -> Array:
        """The stiffness (6,) that skills want along the axes of the compliance frame, N/m and N m/rad."""
        return self._task.tool.compliance.wanted.stiffness.copy()

    @property
    def commanded_wrench(self) -> Array:
        """The wrench (6,) that skills want exerted along the axes of the compliance frame, N and N m."""
        return np.concatenate([self._task.tool.compliance.wanted.force, np.zeros(3)])

    @property
    def pushing(self) -> bool:
        """Whether the tool pushes, or what it pushed with has not faded yet."""
        return self._task.tool.compliance.pushing

    def release(self, axis: Array, stiffness: float = 0.0) -> None:
        """Let the tool yield along a unit direction (3,), fixed to the reference tool frame; stiffness in N/m.

        Without a push the tool stays where it is; pushed with F it moves with about F / release damping.
        Nested releases must be parallel or at right angles to the first, else ValueError.
        """
        self._task.move_tool().compliance.release(self._in_tool(axis), stiffness)

    def restore(self) -> None:
        """Undo the last release: hold the tool, along what it has yielded, where it is now. Gives up a motion."""
        if self._task.joints is not None:
            self._task.tool.compliance.restore(np.zeros(3))
        else:
            self._task.tool.restore(self._task.now)

    def yields_along(self, axis: Array) -> bool:
        """Tell whether the tool was released along a direction (3,)."""
        return self._task.joints is None and self._task.tool.compliance.yields(self._in_tool(axis))

    def release_rotation(self) -> None:
        """Let the tool turn about the two axes across the released one."""
        self._task.move_tool().compliance.set_rotation_free(True)

    def restore_rotation(self) -> None:
        """Hold the tool in the rotation that it has now. Gives up a motion."""
        if self._task.joints is not None:
            self._task.tool.compliance.set_rotation_free(False)
        else:
            self._task.tool.restore_rotation(self._task.now)

    def push(self, axis: Array, force_n: float, fastest_m_s: float = inf) -> None:
        """Press against what lies opposite to `axis` (3,), along which the tool must yield; else ValueError.

        The tool is braked where it goes faster that way than `fastest_m_s`, whoever pushes it.
        """
        tool = self._task.move_tool()
        tool.push(-self._task.measured.in_base(axis), force_n, fastest_m_s, self._task.now)

    def push_off(self) -> None:
        """Let the push fade."""
        self._task.tool.compliance.push_off()

    def start_push(self, push: GuardedPush) -> ActivePush:
        """Begin to approach and then to press; what is returned says how far it is."""
        active = ActivePush(push, self._task.measured.in_base(push.along))
        self._approach(push)
        self.active_pushes = (*self.active_pushes, active)
        return active

    def end_push(self, push: PushProgress) -> None:
        """Stop pushing."""
        self._forget(push)
        self.push_off()

    def evaluate(self, active: ActivePush, state: ArmState) -> str | None:
        """Go on with a push, once a control period; return why it is given up, for the arm to stop, or None."""
        match active.step(state, self._task.contact_wrench, self._task.period):
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

    def secure(self) -> bool:
        """Push no more and hold stiff, whatever skills left; tell whether they left the arm yielding."""
        self.active_pushes = ()
        compliance, left = self._task.tool.compliance, not self._task.tool.compliance.stiff
        while compliance.released:
            self.restore()
        if not compliance.stiff:
            self.restore_rotation()
        return left

    def _forget(self, push: PushProgress) -> None:
        self.active_pushes = tuple(each for each in self.active_pushes if each is not push)

    def _approach(self, push: GuardedPush) -> None:
        """Push no harder than takes the tool along at the speed of the approach."""
        self._press(push, push.approach_m_s * self._release_damping)

    def _press(self, push: GuardedPush, force_n: float) -> None:
        """Push, and let nobody push the tool much faster than it approaches: it would hit what it meets."""
        self.push(push.along, force_n, FALL_SHARE * push.approach_m_s)

    def _in_tool(self, direction: Array) -> Array:
        """Return a direction (3,) of the world in the reference tool frame."""
        return self._task.tool.in_tool(self._task.measured.in_base(direction), self._task.now)
