"""The backends in whose cells tasks can run; each is imported for its first cell."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias, assert_never

if TYPE_CHECKING:
    from skillc_runtime.devices.simulation import Simulation
    from skillc_runtime.world.state.model import WorldModel

BackendName: TypeAlias = Literal["mujoco", "kinematic"]


def make_backend(name: BackendName, world: WorldModel, seed: int, saved: bytes | None = None) -> Simulation:
    """Return a cell in lock step; with physics reality differs from the facts, as `seed` determines.

    All is as in the cell that was `saved`, if there was one. SheetError or FrameError if facts are missing or
    contradict the models, CheckpointError if what was saved cannot be read.
    """
    from skillc_runtime.backends.simulation.checkpoint import decode_checkpoint

    checkpoint = None if saved is None else decode_checkpoint(saved)
    match name:
        case "mujoco":
            from skillc_runtime.backends.mujoco.cell import SimulatedCell

            return SimulatedCell(world, seed, checkpoint=checkpoint)
        case "kinematic":
            from skillc_runtime.backends.kinematic.cell import KinematicCell

            return KinematicCell(world, checkpoint=checkpoint)
        case _:
            assert_never(name)
