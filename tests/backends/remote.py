"""Arms that a control process controls, the robot being in another process, for the conformance suite."""

from __future__ import annotations

import atexit
import time
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from functools import cache
from typing import Any, TypeVar

import pytest

from control_process.toy_link import MUCH_PATIENCE, Toy
from simulation.cells import ARM
from skillc_runtime.backends.control_process.remote_arm import RemoteArmDriver
from skillc_runtime.devices.arm import Arm, ArmLoad, ArmState, Capabilities, Command, Mode, ModeRefused
from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.motion.pose import Array

T = TypeVar("T")
LOOK_S, LONGEST_S = 0.002, 60.0


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


@cache
def open_toy(scene: str) -> tuple[Toy, Any]:
    """Return a robot and its cell, which serve all tests."""
    toy = Toy(scene)
    atexit.register(toy.close)
    cell = toy.open(patience=MUCH_PATIENCE)
    atexit.register(cell.close)
    return toy, cell


class RemoteBackend:
    """One arm of a robot in another process; its time is that of the robot."""

    period_s = 0.001

    def __init__(self, scene: str) -> None:
        """Bring the robot to its home, at rest and with nothing before it."""
        self._toy, self._cell = open_toy(scene)
        self._remote = self._cell._arms[ARM[scene]]
        assert isinstance(self._remote, RemoteArmDriver)
        self.arm, self.driver = RemoteArm(self._remote), RemoteDriver(self._remote)
        self._settle()

    @property
    def force_n(self) -> float:
        return float(self._toy.ask("wall_force_n"))

    def advance(self, seconds: float) -> None:
        self.watch(seconds, lambda: None)

    def watch(self, seconds: float, read: Callable[[], T]) -> list[T]:
        end, late, found = self._now() + seconds, time.monotonic() + LONGEST_S, []
        while self._now() < end:
            assert time.monotonic() < late, self._cell.stops.report
            found.append(read())
            time.sleep(LOOK_S)
        return found

    def neglect(self) -> None:
        pytest.skip("a control process commands its arm as long as it has control")

    def attend(self) -> None:
        """Do nothing."""

    def put_wall(self, gap_m: float) -> Array:
        normal: Array = self._toy.ask("put_wall", gap_m)
        return normal

    def at_once(self) -> AbstractContextManager[object]:
        return nullcontext()

    def close(self) -> None:
        """Leave the robot as it is: the next test brings it home."""

    def _now(self) -> float:
        return self._remote.process.read().number("stamp_s")

    def _settle(self) -> None:
        self._toy.ask("remove_wall")
        if self._cell.stops.report is not None:
            self._cell.stops.clear()
        driver: ArmDriver = self._remote
        self._remote.secure()
        self._remote.set_load(None)
        self.advance(0.3)
        driver.take_fault()
        driver.motion.move_joints(self._toy.ask("home"), 0.3)
        while not driver.motion.done:
            self.advance(0.05)
        self.advance(0.2)
