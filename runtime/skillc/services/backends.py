"""The backends in whose cells tasks can run."""

from __future__ import annotations

from typing import Literal, TypeAlias, assert_never

from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.checkpoint import decode_checkpoint
from skillc_runtime.devices.simulation import Simulation
from skillc_runtime.world.state.model import WorldModel

BackendName: TypeAlias = Literal["mujoco", "kinematic"]


def make_backend(name: BackendName, world: WorldModel, seed: int, saved: bytes | None = None) -> Simulation:
    """Return a cell in lock step; with physics reality differs from the facts, as `seed` determines.

    All is as in the cell that was `saved`, if there was one. SheetError or FrameError if facts are missing or
    contradict the models, CheckpointError if what was saved cannot be read.
    """
    checkpoint = None if saved is None else decode_checkpoint(saved)
    match name:
        case "mujoco":
            return SimulatedCell(world, seed, checkpoint=checkpoint)
        case "kinematic":
            return KinematicCell(world, checkpoint=checkpoint)
        case _:
            assert_never(name)
