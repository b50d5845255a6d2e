"""Brings the devices of a cell to rest, and tells whether they are."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import partial
from typing import Protocol

from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.devices.gripper import Gripper


class StoppableArm(ArmDriver, Protocol):
    """An arm's driver with what its cell needs."""

    @property
    def at_rest(self) -> bool:
        """Whether reference and joints are at rest and no skill pushes."""
        ...

    def abort(self, reason: str) -> None:
        """Stop; the reason is reported as a fault."""
        ...

    def secure(self) -> bool:
        """Come to rest, stop pushing and restore all releases; tell whether any were left."""
        ...


class DeviceStopper:
    """Stops arms, grippers and bases, each given by IRI; where `devices` is None, all are meant.

    `lost` are the arms that do not answer: they stand still.
    """

    def __init__(
        self,
        arms: Mapping[str, StoppableArm],
        grippers: Mapping[str, Gripper],
        bases: Mapping[str, MobileBase],
        names: Mapping[str, str],
    ) -> None:
        self._arms, self._grippers, self._bases, self._names = arms, grippers, bases, names
        self.lost = set[str]()

    def at_rest(self, devices: Collection[str] | None = None) -> bool:
        """Tell whether arms and bases neither move nor push."""
        moving: dict[str, StoppableArm | MobileBase] = {**self._arms, **self._bases}
        return all(
            each.at_rest or name in self.lost for name, each in moving.items() if devices is None or name in devices
        )

    def abort(self, reason: str) -> None:
        """Stop all devices; arms report the reason as a fault.

        One that raises an error keeps no other from being stopped; the first error is raised then.
        """
        errors = []
        stops: list[Callable[[], None]] = [partial(arm.abort, reason) for arm in self._arms.values()]
        stops += [partial(self.stop, (each,)) for each in (*self._grippers, *self._bases)]
        for stop in stops:
            try:
                stop()
            except Exception as error:  # noqa: BLE001  the boundary to the devices
                errors.append(error)
        if errors:
            raise errors[0]

    def stop(self, devices: Collection[str] | None = None) -> None:
        """Stop grippers and bases."""
        for name, gripper in self._grippers.items():
            if gripper.moving and (devices is None or name in devices):
                gripper.stop()
        for name, base in self._bases.items():
            if not base.at_rest and (devices is None or name in devices):
                base.stop()

    def secure(self, devices: Collection[str] | None = None) -> tuple[str, ...]:
        """Stop devices and pushes, and restore releases; return what was not in order."""
        found = []
        for individual, arm in self._arms.items():
            if devices is not None and individual not in devices:
                continue
            if (fault := arm.take_fault()) is not None:
                found.append(f"{self._names[individual]} had stopped: {fault}")
            if arm.secure():
                found.append(f"{self._names[individual]} was left yielding; it is held stiff again")
        self.stop(devices)
        return tuple(found)
