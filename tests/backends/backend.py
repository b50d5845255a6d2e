"""What the conformance suite needs of a backend, and the backends there are.

A new one adds a function to `BACKENDS` that opens it. One for a robot has the suite in a file of its own, beside its
emulator: `tests/robots/NAME/test_conformance.py` imports all of `backends.test_conformance`, and has a fixture `make`
of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack
from functools import partial
from typing import Any, Protocol, TypeAlias, TypeVar

import numpy as np

from simulation.cells import ARM, world
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.real_time.cell import RealTimeCell
from skillc_runtime.backends.real_time.locked import DRIVER_PARTS, CellLock, locked
from skillc_runtime.backends.simulation.arms.arm import ModelledArm
from skillc_runtime.backends.simulation.cell import ModelledCell
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.devices.arm import Arm
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import COMPLIANT_CONTROLLER

T = TypeVar("T")

WALL_N_M, WALL_N_S_M = 4000.0, 40.0
"""Stiffness and damping of the wall."""


class Backend(Protocol):
    """One arm with its driver, which holds it still at first, free to move 10 cm; and a wall to put before it."""

    arm: Arm
    driver: CompliantArmDriver
    period_s: float

    def advance(self, seconds: float) -> None:
        """Let time pass; the driver is stepped."""
        ...

    def watch(self, seconds: float, read: Callable[[], T]) -> list[T]:
        """Let time pass; return what was read in each control period."""
        ...

    def neglect(self) -> None:
        """Let nobody command the arm from now on, until `attend`."""
        ...

    def attend(self) -> None:
        """Let the driver command the arm again."""
        ...

    def put_wall(self, gap_m: float) -> Array:
        """Put a soft wall before the tool, along its z; return the unit vector out of the wall, in the world."""
        ...

    @property
    def force_n(self) -> float:
        """With how much the tool really presses on the wall."""
        ...

    def at_once(self) -> AbstractContextManager[object]:
        """Let no time pass within the block."""
        ...

    def close(self) -> None:
        """End what runs in threads."""
        ...


class Wall:
    """A force that a spring and a damper exert on the hand of an arm, in every step of a cell."""

    rows = None

    def __init__(self, cell: ModelledCell[Any, Any], arm: ModelledArm, palm: str, gap_m: float) -> None:
        self._period, self._arm, self._hand = cell.model.opt.timestep, arm, cell.data.body(palm)
        tool = arm.base @ arm.state().tool
        self.normal, self.force_n, self._depth = -tool.rotation[:, 2], 0.0, 0.0
        self._place = float(self.normal @ tool.position) - gap_m

    def step(self, now: float) -> None:
        """Push at the tool centre point: a force at the hand's centre of mass and its moment."""
        point = (self._arm.base @ self._arm.state().tool).position
        depth = self._place - float(self.normal @ point)
        damping = WALL_N_S_M * (depth - self._depth) / self._period
        self.force_n, self._depth = max(0.0, WALL_N_M * depth + damping) if depth > 0 else 0.0, depth
        force = self.force_n * self.normal
        self._hand.xfrc_applied[:3], self._hand.xfrc_applied[3:] = force, np.cross(point - self._hand.xipos, force)


class Reader:
    """Reads something in every step of a cell."""

    rows = None

    def __init__(self, read: Callable[[], Any]) -> None:
        self._read, self.found = read, list[Any]()

    def step(self, now: float) -> None:
        self.found.append(self._read())


class ModelBackend:
    """The arm of a cell that is computed from a model, in lock step or with a control thread."""

    def __init__(self, cell: SimulatedCell | KinematicCell, clock: RealTimeCell | None = None) -> None:
        self._cell, self._clock, self._lock = cell, clock, CellLock() if clock is None else clock._turn
        facts = cell.scene.arms[0]
        assert facts.gripper is not None
        self.period_s, self._steps = cell.period_s, cell.steps
        self._palm = part_name(cell.scene.names[facts.gripper.individual], "palm")
        self.arm = self._real_arm = cell.arms[facts.individual]
        self.driver = cell.arm(facts.individual)
        if clock is not None:
            self.arm, self.driver = locked(self.arm, self._lock), locked(self.driver, self._lock, DRIVER_PARTS)
        self._wall: Wall | None = None

    @property
    def force_n(self) -> float:
        return 0.0 if self._wall is None else self._wall.force_n

    def advance(self, seconds: float) -> None:
        (self._clock or self._cell).advance(seconds)

    def watch(self, seconds: float, read: Callable[[], T]) -> list[T]:
        reader = Reader(read)
        with self._lock:
            self._add(reader)
        self.advance(seconds)
        with self._lock:
            self._cell.people = self._cell.people[:-1]
        return reader.found

    def neglect(self) -> None:
        self._cell.steps = self._cell.steps_without_control

    def attend(self) -> None:
        self._cell.steps = self._steps

    def call_in_python(self) -> None:
        """Let methods be called that machine code would pass by."""
        self._cell.steps.runs_program = False

    def put_wall(self, gap_m: float) -> Array:
        with self._lock:
            self._wall = Wall(self._cell, self._real_arm, self._palm, gap_m)
            self._add(self._wall)
        return self._wall.normal

    def at_once(self) -> AbstractContextManager[object]:
        return self._lock

    def close(self) -> None:
        if self._clock is not None:
            self._clock.close()

    def _add(self, acting: Wall | Reader) -> None:
        self._cell.people = (*self._cell.people, acting)  # type: ignore[assignment]


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


def real_time(scene: str, controller: str | None = None) -> ModelBackend:
    """Return an arm without physics whose control periods run in a thread, at four times the pace of the wall clock."""
    cell = KinematicCell(scene_with(scene, controller))
    return ModelBackend(cell, RealTimeCell(cell, pace=4.0))


ARMS = {
    "iiwa14": ("iiwa_table",),
    "ur5e": ("ur5e_whiteboard",),
    "ur5e velocity": ("ur5e_whiteboard", "forward_dynamics_velocity"),
    "panda": ("panda_desk",),
}

MakeBackend: TypeAlias = Callable[[], Backend]
"""Returns an arm at its home, at rest and with nothing before it."""

OpenBackend: TypeAlias = Callable[[ExitStack], MakeBackend]
"""Starts what serves all tests of a module, to be ended with the stack."""


def open_toy(scene: str, opened: ExitStack) -> MakeBackend:
    """Start the toy robot of a scene, whose law runs in a control process."""
    from control_process.conformance import open_toy

    return open_toy(scene, opened)


def _open_model(make: MakeBackend, _: ExitStack) -> MakeBackend:
    return make


BACKENDS: dict[str, OpenBackend] = {
    **{
        f"{name} {arm}": partial(_open_model, partial(make, *how))
        for name, make in (("mujoco", mujoco), ("kinematic", kinematic), ("kinematic thread", real_time))
        for arm, how in ARMS.items()
    },
    **{f"toy {arm}": partial(open_toy, ARMS[arm][0]) for arm in ("iiwa14", "ur5e")},
}
