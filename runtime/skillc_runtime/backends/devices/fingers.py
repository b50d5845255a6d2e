"""A gripper whose controller is driven over a network, in a thread of its own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from threading import Event, Lock, Thread
from typing import Protocol

from skillc_runtime.backends.devices.measured_gripper import Hold, MeasuredGripper
from skillc_runtime.backends.simulation.scene_spec import GripperSpec
from skillc_runtime.devices.backend import BackendUnavailable

POLL_S = 0.02
"""How often a gripper is asked for its state, in s."""

CLOSE_S = 2.0
"""How long the end of the thread of a gripper is waited for, in s."""


class FingersLost(Exception):
    """A gripper does not answer any more, or reports a fault; the message names it."""


@dataclass(frozen=True, slots=True)
class FingerState:
    """What a gripper reports: the opening in m, whether its fingers move, and whether something keeps them apart."""

    opening_m: float
    moving: bool
    blocked: bool


class FingerDevice(Protocol):
    """The protocol of one kind of gripper; all methods are called in one thread."""

    @property
    def name(self) -> str:
        """The gripper and its address, for messages."""
        ...

    def connect(self) -> None:
        """Connect, so that its state can be read; nothing moves. BackendUnavailable, with what to do."""
        ...

    def activate(self) -> None:
        """Make it ready to move, for which its fingers may move; BackendUnavailable, with what to do."""
        ...

    def read(self) -> FingerState:
        """Return its state; FingersLost."""
        ...

    def move(self, opening_m: float, force_n: float) -> None:
        """Begin to move the fingers to an opening in m with at most a force in N; FingersLost."""
        ...

    def stop(self) -> None:
        """Stop the fingers where they are; FingersLost."""
        ...

    def close(self) -> None:
        """Disconnect; raises nothing."""
        ...


class Fingers(MeasuredGripper):
    """One gripper."""

    def __init__(
        self,
        device: FingerDevice,
        facts: GripperSpec,
        hold: Hold,
        let_go: Callable[[], None],
        observed: bool = False,
    ) -> None:
        """Connect, and make it ready to move unless it is only `observed`; BackendUnavailable, with what to do."""
        super().__init__(device.name, facts, hold, let_go)
        self._device = device
        self._lock, self._wake, self._closing = Lock(), Event(), Event()
        self._order: Callable[[], None] | None = None
        self._is_new = False
        self._fault: str | None = None
        device.connect()
        try:
            if not observed:
                device.activate()
            self._state = device.read()
        except FingersLost as lost:
            device.close()
            raise BackendUnavailable(str(lost)) from lost
        except BackendUnavailable:
            device.close()
            raise
        self._thread = Thread(target=self._run, name=f"gripper {device.name}", daemon=True)
        self._thread.start()

    @property
    def opening_m(self) -> float:
        """The measured distance between the fingers in m."""
        return self._state.opening_m

    @property
    def moving(self) -> bool:
        """Whether the fingers still move towards the commanded opening, as far as the gripper has told since then."""
        with self._lock:  # wait ends: at once, since no call is made with it
            return self._fault is None and (self._is_new or self._state.moving)

    @property
    def blocked(self) -> bool:
        """Whether something keeps the fingers from closing."""
        return not self.moving and self._state.blocked and self.opening_m > self.opening_error_m

    def move(self, opening_m: float, force_n: float) -> None:
        """Move the fingers to an opening in m with at most a force in N, both limited to those of the gripper."""
        opening = min(max(opening_m, 0.0), self.max_opening_m)
        force = min(force_n, self.max_force_n)
        self._send(lambda: self._device.move(opening, force))

    def stop(self) -> None:
        """Stop the fingers at their present opening."""
        self._send(self._device.stop)

    def find_fault(self) -> str | None:
        """Return why the gripper cannot go on, or that it has lost what it held; None if all is well."""
        if self._fault is None and self._held is not None and self.holding is None:
            thing, opening = self._held
            return (
                f"{self._device.name} has lost {thing.rpartition('#')[2]}: its fingers have closed from "
                f"{1e3 * opening:.0f} mm to {1e3 * self.opening_m:.0f} mm"
            )
        return self._fault

    def recover(self) -> None:
        """Connect again after a fault, and forget what was lost; BackendUnavailable."""
        if self._held is not None and self.holding is None:
            self.detach()
        if self._fault is not None:
            self._device.close()
            self._device.connect()
            self._device.activate()
            with self._lock:  # wait ends: at once, since no call is made with it
                self._order, self._is_new, self._fault = None, False, None

    def close(self) -> None:
        """Leave the fingers as they are, and disconnect."""
        self._closing.set()
        self._wake.set()
        self._thread.join(CLOSE_S)
        self._device.close()

    def _send(self, order: Callable[[], None]) -> None:
        with self._lock:  # wait ends: at once, since no call is made with it
            self._order, self._is_new = order, True
        self._wake.set()

    def _run(self) -> None:
        while not self._closing.is_set():
            if self._fault is None:
                try:
                    self._serve()
                except FingersLost as lost:
                    self._fault = str(lost)
            self._wake.wait(POLL_S)
            self._wake.clear()

    def _serve(self) -> None:
        """Pass on the last order, and read the state after it."""
        with self._lock:  # wait ends: at once, since no call is made with it
            order, self._order = self._order, None
        if order is not None:
            order()
        state = self._device.read()
        with self._lock:  # wait ends: at once, since no call is made with it
            self._state = state
            if self._order is None:
                self._is_new = False
