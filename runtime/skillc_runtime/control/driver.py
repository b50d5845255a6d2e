"""The driver of one arm: commands it once a control period and stops it on faults."""

from __future__ import annotations

from skillc_runtime.control.arm_task import ArmTask
from skillc_runtime.control.blind_stop import BlindStop, make_blind_stop
from skillc_runtime.control.compliance_control import ComplianceControl
from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.motion_control import MotionControl
from skillc_runtime.control.period import (
    BAD_COMMAND,
    BEYOND_LIMIT,
    BLOCKED,
    IMPLAUSIBLE,
    NOT_FINITE,
    OVERLAY_OVER,
    PUSH_ACTS,
    TOOL_MOVED,
    WATCHED,
)
from skillc_runtime.control.period_memory import Control, ControlPeriod
from skillc_runtime.control.setup import ArmSetup
from skillc_runtime.control.supervision.command_validator import CommandValidator
from skillc_runtime.devices.arm import ArmState, Command
from skillc_runtime.motion.numerics.compiled import compile_imported
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.reference import Compliance, Reference


class CompliantArmDriver:
    """One arm, stepped every control period; implements `ArmDriver` and the functions that a cell needs.

    `fault` says why the driver stopped by itself, until it is taken; `broken` why the arm could not be controlled at
    some time, and `violation` which safety limit it exceeded first, until `recover`.
    """

    def __init__(self, setup: ArmSetup) -> None:
        """Hold the arm at its position; a safety limit that it violates is reported in `fault`."""
        self._arm, self._task = setup.arm, ArmTask(setup)
        self.limits, self.task_limits = setup.limits, setup.gains.limits
        self.measured = self._task.measured
        self.motion = MotionControl(self._task, setup.safety.tool_speed_m_s)
        self.compliance = ComplianceControl(self._task, setup.gains.law.release_damping)
        self._validator = CommandValidator(setup.arm, self.measured.state, setup.safety)
        self._safety = self._validator.safety
        if setup.arm.capabilities.measures_link_torques and (observer := self._safety.momentum_observer) is not None:
            self._task.taring.impulse = observer.memory.total
        compile_imported()
        self._period = ControlPeriod(setup.arm, self._task, self._validator, self.compliance.pushes)
        self.measured.has_link_sensors = setup.arm.capabilities.measures_link_torques
        self.measured.felt_wrench = lambda: self._safety.felt_wrench(self.measured.state)
        self.fault: str | None = None
        self.broken: str | None = None
        self.violation: str | None = None
        self._blind: BlindStop | None = None

    @property
    def speed(self) -> float:
        """The share, above 0 to 1, of their speeds that motions and approaches have."""
        return self._task.speed

    def set_speed(self, share: float) -> None:
        """Let motions, also the present one, and approaches have this share of their speeds."""
        self._task.set_speed(share)

    @property
    def at_rest(self) -> bool:
        """Whether reference and joints are at rest and no skill pushes."""
        if self._blind is not None:
            return self._blind.is_over
        return self.motion.at_rest and not self.compliance.pushing and self.measured.still

    @property
    def outside_workspace_m(self) -> float:
        """How far the tool is outside the arm's workspace, in m; 0 inside, or without a workspace."""
        space = self._safety.limits.workspace
        return 0.0 if space is None else space.outside(self._arm.state().tool.position)

    @property
    def tool_target(self) -> tuple[Reference, Compliance] | None:
        """What the tool shall do, in the axes of the arm's base, as of the last period; None while joints are moved."""
        task = self._task
        return None if task.joints is not None else (task.tool.reference, task.tool.compliance.applied)

    def step(self, now: float) -> None:
        """Run one control period at `now` s. ControlError if a measurement or a command is not finite."""
        period = self._period
        period.begin(now)
        self._task.measured.state = period.measure()
        if self._blind is not None:
            self._arm.command(self._blind.command())
            return
        self.act(period.control() if period.is_computed else period.watch())

    @property
    def functions(self) -> tuple[Control, Control] | None:
        """What `step` calls if nothing happens, before and after it measures; then `values` (nv,) are commanded.

        None if only Python can; if the second one returns bits, `act` does the rest.
        """
        return self._period.functions if self._blind is None else None

    @property
    def values(self) -> Array:
        """The command (nv,) that `functions` compute, in N m, rad or rad/s; the array changes, and stays."""
        return self._period.values

    def act(self, events: int) -> None:
        """Do what is left of a control period whose measured state, and perhaps command, has been computed."""
        try:
            acts = self._command(events, self._task.measured.state)
        except ControlError as fault:
            self.broken = str(fault)
            raise
        if acts and (reason := self.compliance.act()) is not None:
            self.abort(reason)

    def _command(self, events: int, state: ArmState) -> bool:
        """Act on what was found, and command the arm for a control period; tell whether a push has an action."""
        task, period = self._task, self._period
        if events & WATCHED:
            self._handle(events, state)
            if self._blind is not None:
                self._arm.command(self._blind.command())
                return False
            events = period.control(is_watched=True) if period.is_computed else 0
        if period.is_computed:
            return self._take(events, state)
        try:
            command = task.command(state)
        except ControlError as fault:
            command = self._hold_joints(state, str(fault))
        self._validator.command(command, task.period)
        return bool(self.compliance.active_pushes) and bool(period.advance_pushes())

    def _take(self, events: int, state: ArmState) -> bool:
        """Command the arm what was computed; tell whether a push has an action."""
        if events & OVERLAY_OVER:
            self._task.tool.reference_generator.forget_faded(self._task.now)
        if events & BAD_COMMAND:
            self._validator.refuse_command()
        try:
            if events & BLOCKED:
                self._period.give_up(state)
            command = self._period.command
        except ControlError as fault:
            command = self._hold_joints(state, str(fault))
        self._arm.command(command)
        return bool(events & PUSH_ACTS)

    def _handle(self, events: int, state: ArmState) -> None:
        """Act on what was found in the measured state."""
        if events & NOT_FINITE:
            self._validator.refuse_measurement()
        if events & IMPLAUSIBLE:
            self._stop_blindly(state)
        if events & TOOL_MOVED:
            self._task.restart_tool(state)
        if events & BEYOND_LIMIT:
            # What an arm feels while it stops is not why it has stopped.
            if self.violation is None:
                self.violation = self._safety.describe(state) or "a limit of the arm was exceeded"
            self.hold_still(self.violation)

    def take_fault(self) -> str | None:
        """Return why the arm stopped by itself, once; None if it did not."""
        fault, self.fault = self.fault, None
        return fault or self._task.taring.take_fault()

    def check_measurements(self) -> None:
        """Hold the arm at its last known position and raise ControlError if what it measures is no number."""
        self._validator.check(self._arm.state())

    def recover(self) -> None:
        """Forget why the arm stopped by itself; what is measured from then on counts again."""
        self.broken = self.violation = None
        if self._blind is not None:
            self._blind = None
            if hasattr(self._arm, "set_brakes"):  # An arm need not be derived from `Arm`.
                self._arm.set_brakes(False)
            self._safety.forget_signals()
            self._task.hold_joints(self._arm.state())

    def abort(self, reason: str) -> None:
        """Stop motion, overlays and push, and hold released axes; the reason is reported in `fault`."""
        self.fault = reason
        self._task.stop()
        self._task.tool.let_go(self._task.now)
        self.compliance.abandon()

    def hold_still(self, reason: str) -> None:
        """Hold the arm at its position, at once, and stop pushing; the reason is reported in `fault`."""
        self.fault = reason
        self._task.hold_still()
        self.compliance.abandon()

    def _stop_blindly(self, state: ArmState) -> None:
        """Come to rest by nothing that is measured now, until `recover`."""
        signals, pushes = self._safety.memory.signals, self.compliance.active_pushes
        axis = pushes[0].axis if pushes else None
        self._blind = make_blind_stop(self._arm, signals, self._task, state, self._validator.holds, axis)
        self.violation = self._safety.describe_signals()
        self.hold_still(self.violation)

    def secure(self) -> bool:
        """Come to rest, stop pushing and restore all releases; tell whether any were left."""
        self._task.stop()
        self._task.tool.let_go(self._task.now)
        return self.compliance.secure()

    def _hold_joints(self, state: ArmState, why: str) -> Command:
        """Abandon a law that cannot continue; return the command that holds the last known position."""
        self._task.hold_joints(state)
        self.broken = why
        self.abort(why)
        return self._validator.holding()
