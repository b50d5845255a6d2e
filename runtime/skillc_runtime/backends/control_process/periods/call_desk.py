"""Answers the calls that concern the driver of an arm, between two cycles."""

from __future__ import annotations

from itertools import count
from typing import Any

from skillc_runtime.backends.control_process.calls import OFFERED, RemoteCall
from skillc_runtime.backends.control_process.periods.controlled_arm import ControlledArm
from skillc_runtime.devices.guarded_push import GuardedPush, MeasuredForce

KEPT_PUSHES = 4
"""Pushes of which the force can still be asked for."""


class CallDesk:
    """Calls functions of the driver of one arm; pushes are known by numbers on the other side."""

    def __init__(self, arm: ControlledArm) -> None:
        self._arm, self._numbers = arm, count(1)

    def call(self, call: RemoteCall) -> Any:
        """Return what a call of a part of the driver returns; errors are those of the driver."""
        if call.name not in OFFERED[call.part]:
            raise ValueError(f"nothing is called {call.part}.{call.name}")
        match call.name:
            case "start_push":
                return self._start_push(*call.arguments)
            case "end_push" | "withdraw":
                return self._call_part(call, (self._arm.pushes[call.arguments[0]],))
            case "set_speed":
                return self._arm.set_speed(*call.arguments)
            case "push_force":
                return self._find_force(*call.arguments)
            case _:
                return self._call_part(call, call.arguments)

    def _call_part(self, call: RemoteCall, arguments: tuple[Any, ...]) -> Any:
        driver = self._arm.driver
        value = getattr(driver if call.part == "driver" else getattr(driver, call.part), call.name)
        return value(*arguments) if callable(value) else value

    def _start_push(self, push: GuardedPush) -> int:
        pushes, number = self._arm.pushes, next(self._numbers)
        pushes[number] = self._arm.driver.compliance.start_push(push)
        for old in sorted(pushes)[:-KEPT_PUSHES]:
            del pushes[old]
        return number

    def _find_force(self, number: int) -> MeasuredForce:
        return self._arm.pushes[number].force
