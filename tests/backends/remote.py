"""Arms that a control process controls, the robot being in another one, for the conformance suite."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from typing import Any, Protocol, TypeVar

import numpy as np

from skillc_runtime.backends.control_process.handshake import Patience
from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.devices.arm import Arm, ArmLoad, ArmState, Capabilities, Command, Mode, ModeRefused
from skillc_runtime.motion.pose import Array
from waiting import LONG_S

T = TypeVar("T")
LOOK_S = 0.002

CONFORMANCE = Patience(tree_s=1.5, process_s=60.0, gap_s=60.0)
"""With this, cells of the suite are opened: an arm that is neglected stops while it still moves slowly."""


class Surroundings(Protocol):
    """What the emulator of a robot is told and asked from outside, as a person in the cell would."""

    home: Array
    """A posture (nv,) in rad from which the tool can move 10 cm in all directions."""

    def put_wall(self, gap_m: float) -> Array:
        """Put a soft wall before the tool, along its z; return the unit vector out of the wall, in the world.

        `Wall` of `backends.backend` says how soft.
        """
        ...

    def remove_wall(self) -> None:
        """Take it away; nothing happens if there is none."""
        ...

    def wall_force_n(self) -> float:
        """Return with how much the tool really presses on the wall; 0 without one."""
        ...

    def violations(self) -> Sequence[str]:
        """Return which commands so far were beyond the limits that the maker of the robot has published."""
        ...


class RemoteArm(Arm):
    """The arm behind a control process, which commands it alone."""

    def __init__(self, driver: RemoteArmDriver) -> None:
        self._driver, connected = driver, driver.process.connected
        self._mode = connected.mode
        able = connected.abilities
        feels = able.wrench != "none"
        self._able = Capabilities((connected.mode,), feels, able.measures_effort, connected.limits)

    @property
    def capabilities(self) -> Capabilities:
        return self._able

    @property
    def interface(self) -> Mode:
        return self._mode

    def switch(self, mode: Mode) -> None:
        if mode != self._mode:
            raise ModeRefused(f"the arm takes {self._mode} commands, not {mode} commands")

    def state(self) -> ArmState:
        return self._driver.measured.state

    def command(self, command: Command) -> None:
        raise TypeError(f"an arm of another process takes no {type(command).__name__}")

    def set_load(self, load: ArmLoad | None) -> None:
        self._driver.set_load(load)

    @property
    def measured_s(self) -> float | None:
        return self._driver.process.read().number("stamp_s")

    def tare(self) -> None:
        self._driver.tare()


class RemoteDriver:
    """The driver with what the suite asks of those in this process."""

    def __init__(self, driver: RemoteArmDriver) -> None:
        self._driver = driver
        self._fault: str | None = None

    def __getattr__(self, name: str) -> Any:
        return getattr(self._driver, name)

    @property
    def fault(self) -> str | None:
        self._fault = self._driver.take_fault() or self._fault
        return self._fault

    def hold_still(self, reason: str) -> None:
        self._driver.process.call("driver", "hold_still", reason)


class RemoteBackend:
    """One arm of a robot in another process; its time is that of the robot."""

    def __init__(self, cell: DeviceCell, individual: str, around: Surroundings) -> None:
        """Bring the robot to its home, at rest and with nothing before it."""
        self._around, self._cell = around, cell
        remote = cell._arms[individual]
        assert isinstance(remote, RemoteArmDriver)
        self._remote, self._beat = remote, remote.process._beat
        self.period_s = remote.process.connected.period_s
        self.arm, self.driver = RemoteArm(remote), RemoteDriver(remote)
        self._settle()

    @property
    def force_n(self) -> float:
        return self._around.wall_force_n()

    def advance(self, seconds: float) -> None:
        self.watch(seconds, lambda: None)

    def watch(self, seconds: float, read: Callable[[], T]) -> list[T]:
        end, late, found = self._now() + seconds, time.monotonic() + LONG_S, []
        while self._now() < end:
            assert time.monotonic() < late, self._cell.stops.report
            found.append(read())
            time.sleep(LOOK_S)
        return found

    def neglect(self) -> None:
        """Let the control process hear nothing of this one, until it has stopped the arm for that."""
        self._remote.process._beat = np.zeros(1)
        while self.driver.fault is None:
            self.advance(0.02)

    def attend(self) -> None:
        self._remote.process._beat = self._beat

    def put_wall(self, gap_m: float) -> Array:
        return self._around.put_wall(gap_m)

    def at_once(self) -> AbstractContextManager[object]:
        return nullcontext()

    def close(self) -> None:
        """Leave the robot as it is: the next test brings it home."""
        assert list(self._around.violations()) == []

    def _now(self) -> float:
        return self._remote.process.read().number("stamp_s")

    def _settle(self) -> None:
        self.attend()
        self._around.remove_wall()
        if self._cell.stops.report is not None:
            self._cell.stops.clear()
        driver = self._remote
        driver.secure()
        driver.set_load(None)
        self.advance(0.3)
        driver.take_fault()
        driver.motion.move_joints(self._around.home, 0.3)
        while not driver.motion.done:
            self.advance(0.05)
        self.advance(0.2)
