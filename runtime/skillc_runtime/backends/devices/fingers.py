"""A gripper whose controller is asked and told over a network, in a thread of its own; implements `Gripper`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from threading import Event, Lock, Thread
from typing import Protocol

from skillc_runtime.devices.backend import BackendUnavailable
from skillc_runtime.devices.gripper import CLOSED_FURTHER_M, Gripper
from skillc_runtime.motion.pose import Pose

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


@dataclass(frozen=True, slots=True)
class FingerFacts:
    """A gripper by its sheet: greatest opening in m, greatest force in N, greatest error of the opening in m."""

    max_opening_m: float
    max_force_n: float
    opening_error_m: float


Hold = Callable[[str, Pose, float], None]
"""Tells an arm what its hand holds: IRI, pose in the tool centre point of the empty hand, and mass in kg."""


class Fingers(Gripper):
    """One gripper; `hold` and `let_go` tell the arm that carries it what it holds."""

    def __init__(
        self,
        device: FingerDevice,
        facts: FingerFacts,
        hold: Hold,
        let_go: Callable[[], None],
        observed: bool = False,
    ) -> None:
        """Connect, and make it ready to move unless it is only `observed`; BackendUnavailable, with what to do."""
        self._device, self._facts, self._hold, self._let_go = device, facts, hold, let_go
        self._lock, self._wake, self._closing = Lock(), Event(), Event()
        self._order: Callable[[], None] | None = None
        self._is_new = False
        self._fault: str | None = None
        self._held: tuple[str, float] | None = None
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
    def max_opening_m(self) -> float:
        """The greatest distance between the fingers in m."""
        return self._facts.max_opening_m

    @property
    def max_force_n(self) -> float:
        """The greatest grasping force in N."""
        return self._facts.max_force_n

    @property
    def opening_m(self) -> float:
        """The measured distance between the fingers in m."""
        return self._state.opening_m

    @property
    def opening_error_m(self) -> float:
        """The greatest error of the measured opening in m."""
        return self._facts.opening_error_m

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

    def attach(self, thing: str, in_tool_centre: Pose, mass_kg: float) -> None:
        """Count an object as held; RuntimeError if the fingers are not blocked, or the scene has no body of it."""
        if not self.blocked:
            raise RuntimeError(f"nothing keeps the fingers of {self._device.name} from closing")
        self._hold(thing, in_tool_centre, mass_kg)
        self._held = thing, self.opening_m

    def detach(self) -> None:
        """Count nothing as held."""
        if self._held is not None:
            self._held = None
            self._let_go()

    @property
    def holding(self) -> str | None:
        """The IRI of the object that counts as held; None as soon as the fingers close further: it was lost."""
        if self._held is None:
            return None
        thing, opening = self._held
        return None if self.opening_m < opening - min(CLOSED_FURTHER_M, opening / 2) else thing

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
