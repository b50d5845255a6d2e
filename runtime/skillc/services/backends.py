"""The backends in whose cells tasks can run."""

from __future__ import annotations

from typing import Literal, TypeAlias, assert_never

from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.simulation import Simulation
from skillc_runtime.world.state.model import WorldModel

BackendName: TypeAlias = Literal["mujoco", "kinematic"]


def make_backend(name: BackendName, world: WorldModel, seed: int) -> Simulation:
    """Return a cell in lock step; with physics reality differs from the facts, as `seed` determines.

    SheetError or FrameError if facts are missing or contradict the models.
    """
    match name:
        case "mujoco":
            return SimulatedCell(world, seed)
        case "kinematic":
            return KinematicCell(world)
        case _:
            assert_never(name)
