"""One arm under control: its model, its driver, the limits of its commands, and why it has stopped."""

from __future__ import annotations

from contextlib import suppress
from typing import Final

import numpy as np
from msgspec.structs import replace

from skillc_runtime.backends.control_process.link import (
    KINDS,
    CommandView,
    ControlRefused,
    LinkAbilities,
    LinkMode,
    StateView,
    make_command,
)
from skillc_runtime.backends.control_process.periods.command_limits import CommandLimits
from skillc_runtime.backends.control_process.periods.command_slot import NOTHING
from skillc_runtime.backends.control_process.periods.device_arm import build_arm
from skillc_runtime.backends.control_process.periods.facts import read_margins, read_rate_limits
from skillc_runtime.backends.simulation.arms.driver_factory import read_setup
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.control.guarded_push import ActivePush
from skillc_runtime.control.measured import is_still
from skillc_runtime.devices.backend import DeviceStop
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation
from skillc_runtime.motion.reference import Compliance, Reference

TOOL: Final = float(KINDS.index("tool"))


def fill_tool(command: CommandView, on_flange: Pose) -> None:
    """Write where the tool centre point is on the flange."""
    command.on_flange[:3], command.on_flange[3:] = on_flange.position, quaternion_from_rotation(on_flange.rotation)


def fill_target(command: CommandView, reference: Reference, compliance: Compliance) -> None:
    """Write reference and compliance of the tool, in the axes of the arm's base."""
    pose, rotation = reference.pose, reference.pose.rotation
    command.kind[0] = TOOL
    command.pose[:3], command.pose[3:] = pose.position, quaternion_from_rotation(rotation)
    command.twist[:] = reference.twist
    command.axes[:] = quaternion_from_rotation(rotation @ compliance.frame)
    command.stiffness[:], command.push[:] = compliance.stiffness, compliance.wrench


LEAST_SPEED = 1e-3
"""The share of their speeds that motions have at least: a speed slider may stand at 0."""

AT_BASE = Pose(np.zeros(3), np.eye(3))


class ControlledArm:
    """The arm of a control process. `driver` has the axes of the arm's base as its world.

    stop: why the arm may not move before somebody has acknowledged that; None if it may.
    """

    def __init__(self, facts: ArmSpec, names: dict[str, str], abilities: LinkAbilities, period_s: float) -> None:
        """Build its model; SheetError if facts are missing, contradict each other, or do not fit the device."""
        self.arm = build_arm(facts, names, abilities, period_s)
        self._setup = replace(read_setup(facts, self.arm, period_s), base=lambda: AT_BASE)
        self.mode = self.arm.interface
        self.link_mode: LinkMode = "tool" if self.arm.has_own_law else self.mode
        self._carries_weight = abilities.carries_weight
        self._limits = CommandLimits(self.arm.limits, read_rate_limits(facts), period_s, read_margins(facts))
        self._out = make_command(facts.home.size)
        self.driver = CompliantArmDriver(self._setup)
        self._speed = self._slider = 1.0
        self.stop: DeviceStop | None = None
        self.pushes: dict[int, ActivePush] = {}

    @property
    def last_push(self) -> tuple[int, ActivePush | None]:
        """The push that was started last, with its number; 0 and None before the first one."""
        return next(reversed(self.pushes.items()), (0, None))

    def begin(self, measured: StateView, now: float) -> None:
        """Prepare to control the arm from where it is measured, at rest; ControlRefused if that cannot be."""
        self.arm.measure(measured, now)
        state = self.arm.state()
        if (reason := self._limits.check_measured(state.q, state.dq)) is not None:
            raise ControlRefused(f"{reason}; move the arm by hand, or correct the facts")
        if not is_still(state.dq):
            raise ControlRefused("the arm moves; wait until it is at rest")
        driver = CompliantArmDriver(self._setup)
        if driver.outside_workspace_m > 0.0:
            outside_mm = 1e3 * driver.outside_workspace_m
            raise ControlRefused(f"the tool is {outside_mm:.0f} mm outside the arm's workspace; move the arm by hand")
        fault, self.driver = self.driver.fault, driver
        self.driver.fault = fault
        self.set_speed(self._speed)
        self._limits.begin(self.mode, measured.target, state.bias)

    def step(self, measured: StateView, now: float) -> CommandView:
        """Run a control period; return the command, in an array that is used again."""
        self.arm.measure(measured, now)
        self._check_joints(measured)
        if self._slider != measured.speed_share[0]:
            self._slider = float(measured.speed_share[0])
            self.set_speed(self._speed)
        with suppress(ControlError):  # The driver has commanded the arm to hold then, and `broken` says why.
            self.driver.step(now)
        self._report_driver()
        slot, out, bias = self.arm.slot.command_for_device, self._out, self.driver.measured.state.bias
        out.buffer[:] = slot.buffer
        if out.kind[0] == NOTHING:
            return out
        if self.link_mode == "tool":
            fill_tool(out, self.arm.tool_on_flange)
        if self.link_mode == "tool" and (target := self.driver.tool_target) is not None:
            fill_target(out, *target)
            self._limits.continue_from(self.mode, measured.q, bias)
            return out
        try:
            self._limits.apply(self.mode, out.values, bias)
        except ControlError as error:
            self.driver.hold_still(str(error))
            self.report(DeviceStop("protective-stop", str(error)))
        if self._carries_weight and self.mode == "torque":
            out.values[:] -= self.arm.weight_torques
        return out

    def set_speed(self, share: float) -> None:
        """Let motions have this share of their speeds, now and after control is taken again.

        The share that a speed slider of the device lets pass is taken of that, so that what is commanded stays near.
        """
        self._speed = share
        self.driver.set_speed(max(share * self._slider, LEAST_SPEED))

    def look(self, measured: StateView, now: float) -> None:
        """Take a measurement without a step, also again after the tool or the zero of the sensor was changed."""
        self.arm.measure(measured, now)
        self.driver.measured.state = self.arm.state()

    def report(self, stop: DeviceStop) -> None:
        """Keep the first reason why the arm has stopped; an emergency stop comes before all others."""
        if self.stop is None or (stop.kind == "emergency-stop" and self.stop.kind != stop.kind):
            self.stop = stop

    def recover(self) -> None:
        """Forget why the arm has stopped."""
        self.driver.recover()
        self.driver.fault = self.stop = None

    def _check_joints(self, measured: StateView) -> None:
        if self.stop is None and (reason := self._limits.check_measured(measured.q, measured.dq)) is not None:
            self.driver.hold_still(reason)
            self.report(DeviceStop("protective-stop", reason))

    def _report_driver(self) -> None:
        if self.stop is None and (reason := self.driver.broken or self.driver.violation) is not None:
            self.report(DeviceStop("protective-stop", reason))
