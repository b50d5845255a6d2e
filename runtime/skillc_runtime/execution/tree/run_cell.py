"""The cell as the primitives of one run see it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.devices.arm import NotOffered
from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.devices.camera import PoseCamera
from skillc_runtime.devices.cell import Cell, Watchdog
from skillc_runtime.devices.gripper import Gripper
from skillc_runtime.devices.sensors import Button, Camera, IoPoint
from skillc_runtime.primitives.primitive import SkillFailure

if TYPE_CHECKING:
    from skillc_runtime.motion.pose import Array
    from skillc_runtime.world.state.model import WorldModel


class RunCell:
    """A view of a cell with the members of `Cell` only; arms and bases move with a share of their speeds.

    `now` is the run's own time in s, which stands still while the run is paused. `arms`, `grippers` and `bases` are
    those that primitives of the run have asked for.
    """

    def __init__(self, cell: Cell, speed: float = 1.0) -> None:
        """Let the arms and bases that are asked for have this share, above 0 to 1, of their speeds."""
        self._cell, self._speed = cell, speed
        self.now = cell.now
        self.arms: dict[str, ArmDriver] = {}
        self.grippers: dict[str, Gripper] = {}
        self.bases: dict[str, MobileBase] = {}

    @property
    def world(self) -> WorldModel:
        """The world model."""
        return self._cell.world

    @property
    def watchdog(self) -> Watchdog:
        """The watchdog of the cell."""
        return self._cell.watchdog

    @property
    def is_still(self) -> bool:
        """Whether the devices that primitives have asked for have come to rest; pushes may go on."""
        return (
            all(arm.motion.stationary and arm.measured.still for arm in self.arms.values())
            and not any(gripper.moving for gripper in self.grippers.values())
            and all(base.at_rest for base in self.bases.values())
        )

    def take_fault(self) -> str | None:
        """Return why one of these arms stopped by itself, once; None if none did."""
        return next((fault for arm in self.arms.values() if (fault := arm.take_fault()) is not None), None)

    def arm(self, individual: str) -> ArmDriver:
        """Return an arm's driver; KeyError if the cell has no such arm."""
        if individual not in self.arms:
            self.arms[individual] = arm = self._cell.arm(individual)
            arm.set_speed(self._speed)
        return self.arms[individual]

    def find_standing_joints(self, individual: str) -> Array | None:
        """Return at which joints (nv,) in rad an arm stands, whoever controls it; None while it moves."""
        return self._cell.find_standing_joints(individual)

    def gripper(self, individual: str) -> Gripper:
        """Return a gripper; KeyError if the cell has no such gripper."""
        return self.grippers.setdefault(individual, self._cell.gripper(individual))

    def base(self, individual: str) -> MobileBase:
        """Return the mobile base of a robot; KeyError if it has none, SkillFailure if it cannot drive so slowly."""
        if individual not in self.bases:
            base = self._cell.base(individual)
            try:
                base.set_speed(self._speed)
            except NotOffered as error:
                raise SkillFailure(str(error)) from error
            self.bases[individual] = base
        return self.bases[individual]

    def pose_camera(self, individual: str) -> PoseCamera:
        """Return a camera that estimates poses; KeyError if the cell has no such camera."""
        return self._cell.pose_camera(individual)

    def camera(self) -> Camera:
        """Return the camera that inspects surfaces."""
        return self._cell.camera()

    def button(self, individual: str) -> Button:
        """Return a button; KeyError if the cell has no such button."""
        return self._cell.button(individual)

    def io_point(self, individual: str) -> IoPoint:
        """Return an input or output; KeyError if the cell has no such I/O point."""
        return self._cell.io_point(individual)
