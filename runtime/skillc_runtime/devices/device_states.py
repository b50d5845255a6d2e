"""The states of the devices of a cell in its world model: idle, or faulty from a stop until that is acknowledged."""

from __future__ import annotations

from collections.abc import Iterable

from skillc_runtime.devices.backend import DeviceStop
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DEVICE_STATE


class DeviceStates:
    """Writes `skillc:deviceState` of devices, by IRI, idle at first; called where the world model may be written."""

    def __init__(self, world: WorldModel, arms: Iterable[str]) -> None:
        self._world, self._arms = world, sorted(arms)
        self._faulty = set[str]()

    def begin(self, arms: Iterable[str] | None = None) -> None:
        """Report that arms, all if None, are idle at the start of the cell."""
        self._report(self._arms if arms is None else arms, "Idle", "start of the cell")

    def note(self, stop: DeviceStop | None) -> None:
        """Report that the devices of a stop are faulty, those of which that was not reported; nothing with None."""
        if stop is None:
            return
        new = [each for each in stop.devices if each not in self._faulty]
        self._faulty.update(new)
        self._report(new, "Fault", stop.reason)

    def clear(self) -> None:
        """Report that what was faulty is idle, because the stop was acknowledged."""
        faulty = sorted(self._faulty)
        self._faulty.clear()
        self._report(faulty, "Idle", "the stop was acknowledged")

    def _report(self, arms: Iterable[str], state: str, origin: str) -> None:
        if changes := [SetProperty(arm, DEVICE_STATE, state) for arm in arms]:
            self._world.commit(changes, origin, "reported")
