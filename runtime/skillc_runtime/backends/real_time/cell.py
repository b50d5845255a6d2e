"""Runs a simulated cell by the wall clock: a thread of its own runs the control periods, as that of a real robot does.

One lock, held for a control period or for one call of a skill, keeps them apart: a skill that starts a motion needs the
answer, such as `Infeasible`, so a mailbox would make it wait for the next period as well. Skills never run in this
thread, and no lock is held between their calls: what they block does not stop the arms' controllers and watchdog.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from math import inf
from threading import Event, Thread
from time import monotonic
from typing import Protocol, TypeVar

from skillc_runtime.backends.real_time.locked import DRIVER_PARTS, CellLock, locked
from skillc_runtime.control.controller import ControlError
from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.devices.backend import Backend, BackendBroken, DeviceStops
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.devices.camera import PoseCamera
from skillc_runtime.devices.capabilities import BackendCapabilities, LockStep
from skillc_runtime.devices.cell import Cell, Watchdog
from skillc_runtime.devices.gripper import Gripper
from skillc_runtime.devices.sensors import Button, Camera, IoPoint
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.model import WorldModel

CATCH_UP_S = 0.1
"""A thread that was not run in time runs the missed control periods at once, up to this time; more is lost."""

SHORTEST_WAIT_S = 1e-4
"""Time between two control periods, at least, in which others get the lock."""

STALL_S = 60.0
"""A control thread that has run no control period for this wall time is given up; its first one compiles the laws."""

BRAKING_S = 2.0
"""After a stop from outside, devices are commanded until they are at rest, or for this time; then they hold still."""

T = TypeVar("T")


class LockStepCell(LockStep, Backend, Cell, Protocol):
    """A cell in lock step, one control period at a time."""

    @property
    def period_s(self) -> float:
        """The control period in s."""
        ...

    def hold_period(self) -> None:
        """Let a control period pass without commands: arms hold still by themselves, grippers and bases stop."""
        ...

    def publish(self) -> None:
        """Write to the world model what devices have reported since the last call."""
        ...

    def stop_all(self, reason: str) -> None:
        """Stop all devices; arms report the reason as a fault."""
        ...


class RealTimeCell:
    """A cell whose time passes with the wall clock, implementing `Cell` and `Backend`.

    `advance` waits. If the machine is too slow, the cell's time falls behind the wall clock; no control period is left
    out. The world model is only written in the threads that call `advance` and `close`.
    """

    def __init__(
        self, cell: LockStepCell, stop_requested: Callable[[], bool] = lambda: False, pace: float = 1.0
    ) -> None:
        """Start the control thread.

        `stop_requested` is asked in every control period, so that another process can stop all devices for good. pace:
        s of the cell per s of the wall clock.
        """
        self._simulated, self._stop_requested, self._wall_period_s = cell, stop_requested, cell.period_s / pace
        self._turn = CellLock()
        self._awaited, self._arrived, self._closing = 0.0, Event(), Event()
        self._broken: str | None = None
        self._error: ControlError | None = None
        self._stopped_at: float | None = None
        self.world: WorldModel = cell.world
        self.watchdog: Watchdog = locked(cell.watchdog, self._turn)
        self.stops: DeviceStops = locked(cell.stops, self._turn)
        self.capabilities = self._offer(cell.capabilities)
        self._thread = Thread(target=self._run, name="control", daemon=True)
        self._thread.start()

    @property
    def now(self) -> float:
        """The time in s since the cell started."""
        return self._simulated.now

    @property
    def cell(self) -> RealTimeCell:
        """The cell as skills see it."""
        return self

    @property
    def clock(self) -> RealTimeCell:
        """The clock of the cell."""
        return self

    @property
    def broken(self) -> str | None:
        """Why the cell cannot go on; None while it can."""
        return self._broken

    def arm(self, individual: str) -> ArmDriver:
        """Return an arm's driver; KeyError if the cell has no such arm."""
        return locked(self._simulated.arm(individual), self._turn, DRIVER_PARTS)

    def find_standing_joints(self, individual: str) -> Array | None:
        """Return at which joints (nv,) in rad an arm stands; None while it moves."""
        with self._turn:
            return self._simulated.find_standing_joints(individual)

    def gripper(self, individual: str) -> Gripper:
        """Return a gripper; KeyError if the cell has no such gripper."""
        return locked(self._simulated.gripper(individual), self._turn)

    def base(self, individual: str) -> MobileBase:
        """Return the mobile base of a robot; KeyError if it has none."""
        return locked(self._simulated.base(individual), self._turn)

    def pose_camera(self, individual: str) -> PoseCamera:
        """Return a camera that estimates poses; KeyError if the cell has no such camera."""
        return locked(self._simulated.pose_camera(individual), self._turn)

    def camera(self) -> Camera:
        """Return the camera that inspects surfaces."""
        return locked(self._simulated.camera(), self._turn)

    def button(self, individual: str) -> Button:
        """Return a button; KeyError if the cell has no such button."""
        return locked(self._simulated.button(individual), self._turn)

    def io_point(self, individual: str) -> IoPoint:
        """Return an input or output; KeyError if the cell has no such I/O point."""
        return locked(self._simulated.io_point(individual), self._turn)

    def is_at_rest(self, devices: Collection[str] | None = None) -> bool:
        """Whether devices, all if None, neither move nor push."""
        with self._turn:
            return not self._thread.is_alive() or self._simulated.is_at_rest(devices)

    def advance(self, seconds: float) -> None:
        """Wait until `seconds` have passed.

        ControlError if a controller could not continue meanwhile, BackendBroken if the cell cannot.
        """
        try:
            with self._turn:
                self._awaited = self.now + seconds - self._simulated.period_s / 2
                self._arrived.clear()
            while self.now < self._awaited and self._broken is None and self._error is None:
                self._wait_for_arrival()
            with self._turn:
                error, self._error = self._error, None
        finally:
            self._simulated.publish()
        if self._broken is not None:
            raise BackendBroken(self._broken)
        if error is not None:
            raise error

    def publish(self) -> None:
        """Write to the world model what devices have reported."""
        self._simulated.publish()

    def secure(self, devices: Collection[str] | None = None) -> Sequence[str]:
        """Stop devices, all if None, and pushes, and restore releases; return what was not in order."""
        with self._turn:
            return self._simulated.secure(devices)

    def close(self) -> None:
        """End the control thread; the cell stands still from then on."""
        self._closing.set()
        self._thread.join(STALL_S)
        self._broken = self._broken or "the cell is closed"
        self._simulated.publish()

    def _offer(self, inside: BackendCapabilities) -> BackendCapabilities:
        """Return what the cell inside offers, one call at a time; by the wall clock no run is repeated."""

        def lock(part: T | None) -> T | None:
            return None if part is None else locked(part, self._turn)

        return BackendCapabilities(
            judge=lock(inside.judge),
            truth=lock(inside.truth),
            drawing=lock(inside.drawing),
            disturber=lock(inside.disturber),
            live=inside.live,
        )

    def _wait_for_arrival(self) -> None:
        """Wait until the awaited time has come or the cell is broken; break it if no period has run for too long."""
        before = self.now
        if not self._arrived.wait(STALL_S) and self.now == before:
            self._break(f"the control thread has not run for {STALL_S:g} s")

    def _run(self) -> None:
        """Run the control periods until the cell is closed or one of them fails."""
        try:
            self._run_periods()
        except BackendBroken as error:
            self._break(str(error))
        except Exception as error:  # noqa: BLE001  the thread's boundary: it reports why it ends
            self._break(f"the control thread has ended: {error!r}")

    def _run_periods(self) -> None:
        """Run a control period whenever one is due, until the cell is closed."""
        due = monotonic()
        while not self._closing.wait(max(due - monotonic(), SHORTEST_WAIT_S)):
            with self._turn:
                self._run_period()
                if self.now >= self._awaited:
                    self._arrived.set()
            due = max(due + self._wall_period_s, monotonic() - CATCH_UP_S)

    def _run_period(self) -> None:
        simulated, reason = self._simulated, "all devices were stopped from outside the run"
        if self._stopped_at is None and self._stop_requested():
            self._stopped_at = self.now
            simulated.stop_all(reason)
            self._break(reason)
        if self._stopped_at is not None and (self.now > self._stopped_at + BRAKING_S or simulated.is_at_rest()):
            self._stopped_at = -inf
            simulated.hold_period()
            return
        try:
            simulated.advance_period()
        except ControlError as error:
            self._error = error
            self._arrived.set()

    def _break(self, reason: str) -> None:
        self._broken = self._broken or reason
        self._arrived.set()
