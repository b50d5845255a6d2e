"""Why devices of a simulated cell have stopped by themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.devices.backend import DeviceStop, StopPersists
from skillc_runtime.devices.device_states import DeviceStates
from skillc_runtime.devices.device_stopper import DeviceStopper


class SimulatedStops:
    """Safety limits, measurements that are no numbers, lost arms and an emergency stop; implements `DeviceStops`."""

    def __init__(
        self,
        arms: Mapping[str, CompliantArmDriver],
        stopper: DeviceStopper,
        states: DeviceStates,
        names: Mapping[str, str],
    ) -> None:
        self._arms, self._stopper, self._states, self._names = arms, stopper, states, names
        self._pressed = False

    @property
    def report(self) -> DeviceStop | None:
        """The worst stop that was reported and not cleared, or whose cause is still there; None for none."""
        if self._pressed:
            return DeviceStop("emergency-stop", "an emergency stop is pressed", tuple(sorted(self._arms)))
        for individual, arm in self._arms.items():
            lost = "it does not answer" if individual in self._stopper.lost else None
            why = lost or arm.broken or arm.violation
            if why is not None:
                return DeviceStop("protective-stop", f"{self._names[individual]}: {why}", (individual,))
        return None

    def clear(self) -> None:
        """Forget the stops, because somebody has acknowledged them; StopPersists, and nothing has changed."""
        if self._pressed:
            raise StopPersists("the emergency stop is still pressed; release it")
        if self._stopper.lost:
            lost = ", ".join(sorted(self._names[each] for each in self._stopper.lost))
            raise StopPersists(f"{lost} does not answer yet; connect it again")
        if problems := [f"{self._names[each]}: {why}" for each, why in self._find_unmeasured()]:
            raise StopPersists("; ".join(problems))
        for arm in self._arms.values():
            arm.recover()
        self._states.clear()

    def press(self, pressed: bool) -> None:
        """Press or release the emergency stop; all devices stop when it is pressed."""
        if pressed and not self._pressed:
            self._stopper.abort("an emergency stop was pressed")
        self._pressed = pressed

    def lose(self, arm: str, lost: bool) -> None:
        """Let an arm of an IRI answer no more, or again; all other devices stop when it does not."""
        if lost and arm not in self._stopper.lost:
            self._stopper.abort(f"{self._names[arm]} does not answer")
            self._stopper.lost.add(arm)
        elif not lost:
            self._stopper.lost.discard(arm)

    def _find_unmeasured(self) -> Iterator[tuple[str, str]]:
        """Yield the arms that report what is no number, each with a description."""
        for individual, arm in self._arms.items():
            try:
                arm.check_measurements()
            except ControlError as error:
                yield individual, str(error)
