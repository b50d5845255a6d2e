"""A back end for a toy robot that runs already; its scene and its ports are in the environment (`SKILLC_TOY`)."""

from __future__ import annotations

import os

import pytest

from control_process.toy_link import MUCH_PATIENCE, Toy
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.devices.backend import BackendStart
from skillc_runtime.world.state.model import WorldModel

VARIABLE = "SKILLC_TOY"


def choose(toy: Toy, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let this process and those that it starts open the cell of a toy."""
    monkeypatch.setenv(VARIABLE, f"{toy.scene} {toy.port} {toy.panel_port}")


def make_backend(world: WorldModel, start: BackendStart) -> DeviceCell:
    """Return the cell of the toy; it is `MakeBackend`."""
    scene, port, panel = os.environ[VARIABLE].split()
    return Toy(scene, running=(int(port), int(panel))).open_world(world, MUCH_PATIENCE, start.observed)
