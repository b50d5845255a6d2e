"""A back end for a toy robot that runs already; its scene and its ports are in the environment (`SKILLC_TOY`)."""

from __future__ import annotations

import os

from control_process.toy_link import MUCH_PATIENCE, Toy
from skillc_runtime.backends.control_process.opening import open_cell
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.devices.backend import BackendStart
from skillc_runtime.world.state.model import WorldModel

VARIABLE = "SKILLC_TOY"


def make_backend(world: WorldModel, start: BackendStart) -> DeviceCell:
    """Return the cell of the toy; it is `MakeBackend`."""
    scene, port, panel = os.environ[VARIABLE].split()
    toy = Toy(scene, running=(int(port), int(panel)))
    return open_cell(world, toy.describe, toy._make_devices, MUCH_PATIENCE, start.observed)
