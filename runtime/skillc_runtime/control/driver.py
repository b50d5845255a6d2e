"""The heart of one arm: commands it once a control period and stops it where it must not go on."""

from __future__ import annotations

from skillc_runtime.control.arm_task import ArmTask
from skillc_runtime.control.command_validator import CommandValidator
from skillc_runtime.control.compliance_control import ComplianceControl
from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.motion_control import MotionControl
from skillc_runtime.control.setup import ArmSetup
from skillc_runtime.devices.arm import ArmState, Command

LONGEST_GAP_S = 0.02
"""When a control period comes later than this after the one before, or earlier, motions wait for the time lost."""


class CompliantArmDriver:
    """One arm, stepped every control period; implements `ArmDriver`, and what a cell needs besides.

    `fault` says why the driver stopped by itself, until somebody has taken it; `broken` why the arm once could not be
    controlled.
    """

    def __init__(self, setup: ArmSetup) -> None:
        """Hold the arm where it is; which of its safety limits it breaks is said in `fault`."""
        self._arm, self._task = setup.arm, ArmTask(setup)
        self.limits, self.task_limits = setup.limits, setup.gains.limits
        self.measured = self._task.measured
        self.motion = MotionControl(self._task, setup.safety.tool_speed_m_s)
        self.compliance = ComplianceControl(self._task, setup.gains.law.release_damping)
        self._validator = CommandValidator(setup.arm, self.measured.state, setup.safety)
        self._safety = self._validator.safety
        self.fault: str | None = None
        self.broken: str | None = None
        self._seen = self._lost = 0.0

    @property
    def at_rest(self) -> bool:
        """Whether nothing moves or pushes any more: neither the reference nor what skills want, nor the arm."""
        return self.motion.at_rest and not self.compliance.pushing and self.measured.still

    def step(self, now: float) -> None:
        """Do one control period at `now` s. ControlError when a measurement or a command is not a number."""
        task, gap, self._seen = self._task, now - self._seen, now
        if not 0 <= gap <= max(LONGEST_GAP_S, 2 * task.period):
            self._lost += gap - task.period
        task.now = now - self._lost
        state = self._arm.state()
        try:
            self._validator.check(state)
            task.update_state(state)
            if (violation := self._safety.violation(state, task.period)) is not None:
                self.hold_still(violation)
            try:
                command = task.command(state)
            except ControlError as fault:
                command = self._hold_joints(state, str(fault))
            self._validator.command(command, task.period)
        except ControlError as fault:
            self.broken = str(fault)
            raise
        for push in self.compliance.active_pushes:
            if (reason := self.compliance.evaluate(push, state)) is not None:
                self.abort(reason)

    def take_fault(self) -> str | None:
        """Return why the arm stopped by itself, once; None while it has not."""
        fault, self.fault = self.fault, None
        return fault

    def abort(self, reason: str) -> None:
        """Stop moving, circling and pushing; whoever moves the arm finds the reason in `fault`."""
        self.fault = reason
        self._task.stop()
        self._task.tool.let_go(self._task.now)

    def hold_still(self, reason: str) -> None:
        """Hold the arm where it is, at once, and push no more; whoever moves it finds the reason in `fault`."""
        self.fault = reason
        self._task.hold_still()

    def secure(self) -> bool:
        """Come to rest, push no more and hold stiff, whatever skills left; tell whether they left the arm yielding."""
        self._task.stop()
        self._task.tool.let_go(self._task.now)
        return self.compliance.secure()

    def _hold_joints(self, state: ArmState, why: str) -> Command:
        """Give up a law that cannot go on; return what holds the arm where it was last known to be."""
        self._task.hold_joints(state)
        self.broken = why
        self.abort(why)
        return self._validator.holding()
