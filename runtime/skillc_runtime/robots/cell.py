"""What primitives work with: the devices of a scene by the IRI of their individual, the time, and the world model."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from skillc_runtime.robots.base import MobileBase
    from skillc_runtime.robots.button import Button
    from skillc_runtime.robots.driver import ArmDriver
    from skillc_runtime.robots.gripper import Gripper
    from skillc_runtime.robots.inspection import Camera
    from skillc_runtime.robots.watchdog import Watchdog
    from skillc_runtime.world.state.model import WorldModel


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
        """Whom every run gives signs of life; when one falls silent, all devices stop."""
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
