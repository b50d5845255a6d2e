"""What primitives work with: the devices of a scene by the IRI of their individual, the time, and the world model."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.devices.gripper import Gripper
from skillc_runtime.devices.sensors import Button, Camera

if TYPE_CHECKING:
    from skillc_runtime.world.state.model import WorldModel


class WatchdogTimeout(Exception):
    """Somebody gave no sign of life for so long that everything has been stopped; the message is for people."""


class Watchdog(Protocol):
    """Stops all devices when whoever moves them gives no signs of life. Times are in s of the cell's clock."""

    def beat(self, who: object, now: float) -> bool:
        """Take a sign of life; False when it comes too late and devices have been stopped meanwhile."""
        ...

    def retire(self, who: object) -> None:
        """Expect nothing of it any more."""
        ...


class Cell(Protocol):
    """A robot cell, simulated or real."""

    @property
    def now(self) -> float:
        """Seconds since the cell started; simulated time in simulation."""
        ...

    @property
    def world(self) -> WorldModel:
        """The world model, which measuring skills update."""
        ...

    @property
    def watchdog(self) -> Watchdog:
        """What every run gives signs of life; when one is missing, all devices stop."""
        ...

    def arm(self, individual: str) -> ArmDriver:
        """Return an arm's driver; KeyError where the cell has no such arm."""
        ...

    def gripper(self, individual: str) -> Gripper:
        """Return a gripper; KeyError where the cell has no such gripper."""
        ...

    def base(self, individual: str) -> MobileBase:
        """Return the mobile base of a robot; KeyError where it has none."""
        ...

    def camera(self) -> Camera:
        """Return what inspects surfaces."""
        ...

    def button(self, individual: str) -> Button:
        """Return a button; KeyError where the cell has no such button."""
        ...
