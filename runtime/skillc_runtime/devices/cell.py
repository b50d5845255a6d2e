"""The interface of a robot cell for primitives: its devices by IRI, the time, and the world model."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.devices.camera import PoseCamera
from skillc_runtime.devices.gripper import Gripper
from skillc_runtime.devices.sensors import Button, Camera, IoPoint

if TYPE_CHECKING:
    from skillc_runtime.motion.pose import Array
    from skillc_runtime.world.state.model import WorldModel


class WatchdogTimeout(Exception):
    """A client sent no heartbeat for so long that all devices have been stopped; the message says so."""


class Watchdog(Protocol):
    """Stops all devices if a client sends no heartbeats any more. Times `now` are in s of the cell's clock."""

    def beat(self, who: object, now: float) -> bool:
        """Receive a heartbeat; False if it is too late and devices have been stopped."""
        ...

    def retire(self, who: object) -> None:
        """Expect no further heartbeats of a client."""
        ...


class Cell(Protocol):
    """A robot cell, simulated or real."""

    @property
    def now(self) -> float:
        """The time in s since the cell started; simulated time in simulation."""
        ...

    @property
    def world(self) -> WorldModel:
        """The world model, which measuring skills update."""
        ...

    @property
    def watchdog(self) -> Watchdog:
        """The watchdog, to which every run sends heartbeats."""
        ...

    def arm(self, individual: str) -> ArmDriver:
        """Return an arm's driver; KeyError if the cell has no such arm."""
        ...

    def find_standing_joints(self, individual: str) -> Array | None:
        """Return at which joints (nv,) in rad an arm stands, whoever controls it; None while it moves.

        KeyError if the cell has no such arm.
        """
        ...

    def gripper(self, individual: str) -> Gripper:
        """Return a gripper; KeyError if the cell has no such gripper."""
        ...

    def base(self, individual: str) -> MobileBase:
        """Return the mobile base of a robot; KeyError if it has none."""
        ...

    def pose_camera(self, individual: str) -> PoseCamera:
        """Return a camera that estimates poses; KeyError if the cell has no such camera."""
        ...

    def camera(self) -> Camera:
        """Return the camera that inspects surfaces."""
        ...

    def button(self, individual: str) -> Button:
        """Return a button; KeyError if the cell has no such button."""
        ...

    def io_point(self, individual: str) -> IoPoint:
        """Return an input or output; KeyError if the cell has no such I/O point."""
        ...
