"""What the conformance suite needs of a back-end, and the back-ends there are.

A new one, simulated or real, adds a function to `BACKENDS` that makes it; nothing else.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Protocol

import numpy as np

from simulation.cells import ARM, world
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.devices.arm import Arm
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import COMPLIANT_CONTROLLER

WALL_N_M, WALL_N_S_M = 4000.0, 40.0
"""Stiffness and damping of the wall."""


class Backend(Protocol):
    """One arm with its driver, which holds it still at first, free to move 10 cm; and a wall to put before it."""

    arm: Arm
    driver: CompliantArmDriver

    def advance(self, seconds: float) -> None:
        """Let time pass; the driver is stepped."""
        ...

    def neglect(self, seconds: float) -> None:
        """Let time pass in which nobody commands the arm."""
        ...

    def put_wall(self, gap_m: float) -> Array:
        """Put a soft wall before the tool, along its z; return the unit vector out of the wall, in the world."""
        ...

    @property
    def force_n(self) -> float:
        """With how much the tool really presses on the wall."""
        ...


class ModelBackend:
    """The arm of a cell that is computed from a model.

    The wall is a force that a spring and a damper exert on the hand.
    """

    def __init__(self, cell: SimulatedCell | KinematicCell) -> None:
        self._cell = cell
        facts = cell.scene.arms[0]
        assert facts.gripper is not None
        self.arm = cell.arms[facts.individual]
        self.driver = cell.arm(facts.individual)
        self._hand = cell.data.body(part_name(cell.scene.names[facts.gripper.individual], "palm"))
        self._normal, self._place, self.force_n = np.zeros(3), 0.0, 0.0
        self._depth = 0.0

    def advance(self, seconds: float) -> None:
        period = self._cell.period_s
        if not self._normal.any():
            self._cell.advance(seconds)
            return
        for _ in range(round(seconds / period)):
            self._press(period)
            self._cell.advance(period)

    def neglect(self, seconds: float) -> None:
        control, self._cell._control = self._cell._control, lambda *_: None  # type: ignore[method-assign]
        self.advance(seconds)
        self._cell._control = control  # type: ignore[method-assign]

    def put_wall(self, gap_m: float) -> Array:
        tool = self.arm.base @ self.arm.state().tool
        self._normal = -tool.rotation[:, 2]
        self._place = float(self._normal @ tool.position) - gap_m
        return self._normal

    def _press(self, period: float) -> None:
        """Let the wall push at the tool centre point: a force at the hand's centre of mass and its moment."""
        point = (self.arm.base @ self.arm.state().tool).position
        depth = self._place - float(self._normal @ point)
        self.force_n = max(0.0, WALL_N_M * depth + WALL_N_S_M * (depth - self._depth) / period) if depth > 0 else 0.0
        self._depth = depth
        force = self.force_n * self._normal
        self._hand.xfrc_applied[:3], self._hand.xfrc_applied[3:] = force, np.cross(point - self._hand.xipos, force)


def scene_with(scene: str, controller: str | None = None) -> WorldModel:
    """Return the world of a shipped scene, with another controller of its arm if one is named."""
    changes = [] if controller is None else [SetProperty(ARM[scene], COMPLIANT_CONTROLLER, controller)]
    return WorldModel(world(scene).with_changes(changes))


def mujoco(scene: str, controller: str | None = None, steps_per_command: int = 1) -> ModelBackend:
    """Return an arm with physics."""
    return ModelBackend(SimulatedCell(scene_with(scene, controller), steps_per_command=steps_per_command))


def kinematic(scene: str, controller: str | None = None) -> ModelBackend:
    """Return an arm without physics."""
    return ModelBackend(KinematicCell(scene_with(scene, controller)))


BACKENDS: dict[str, Callable[[], Backend]] = {
    f"{name} {arm}": partial(make, *how)
    for name, make in (("mujoco", mujoco), ("kinematic", kinematic))
    for arm, how in {
        "iiwa14": ("iiwa_table",),
        "ur5e": ("ur5e_whiteboard",),
        "ur5e velocity": ("ur5e_whiteboard", "forward_dynamics_velocity"),
        "panda": ("panda_desk",),
    }.items()
}
