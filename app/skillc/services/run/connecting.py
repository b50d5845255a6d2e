"""Connects to the devices of a scene without moving them, and looks at them beside what the scene says."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from skillc.errors import RequestError
from skillc.services.project.backends import BackendName, make_backend
from skillc.services.reporting.reporter import Reporter
from skillc.services.scene.stores import StoreChoice
from skillc.services.views.open_scenes import open_scene
from skillc_runtime.devices.observed import CellObserver
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState


@contextmanager
def connected_scene(scene: Path, backend: BackendName, reporter: Reporter) -> Iterator[CellObserver]:
    """Connect to the devices of a scene, in a `with` statement; errors as of `connected_devices` and `open_scene`."""
    with (
        open_scene(scene, None, StoreChoice(), False, reporter) as opened,
        connected_devices(opened.state, backend) as observer,
    ):
        yield observer


@contextmanager
def connected_devices(state: WorldState, backend: BackendName) -> Iterator[CellObserver]:
    """Connect to the devices of a world, in a `with` statement; nothing is taken under control.

    RequestError if facts are missing, or the back end has no devices that can be looked at; ServiceError if a device
    does not answer.
    """
    try:
        cell = make_backend(backend, WorldModel(state), 0, observed=True)
    except (SheetError, FrameError) as error:
        raise RequestError(str(error)) from error
    with closing(cell):
        if (observer := cell.capabilities.observer) is None:
            kind = "simulates its devices" if cell.capabilities.truth is not None else "cannot look at its devices"
            hint = "name a back end of real devices, such as `--backend ur`"
            raise RequestError(f"the backend {backend} {kind}: there is nothing to connect to; {hint}")
        yield observer
