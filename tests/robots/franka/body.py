"""The Franka Control Interface as one of the bodies that carry out tasks."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import franky_sim  # noqa: F401  the table leaves this body out without the robot and what drives it
import pylibfranka  # noqa: F401

from robots.bodies import Opened, Task, TaskName, shipped_task
from robots.franka.cells import real_cell, write_scene
from robots.franka.running import Peer, proxy, robot
from robots.truth import RemoteTruth
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DRIVER_ADDRESS

HERE, TRUTH = Path(__file__).parent, "truth"
TASKS = {
    "wipe": ("wiping", "clean_desk", "desk"),
    "pick and place": ("sorting", "sort_parts", "parts"),
    "press": ("contact", "press_button_panda", "button"),
}
"""Library and task of the Panda, and the things that the simulated robot has around it."""


class FrankaBody:
    """Implements `Body`."""

    def task(self, name: TaskName, folder: Path) -> Task:
        library, task, things = TASKS[name]
        write_scene(library, task, folder / f"{things}.ttl")
        return replace(shipped_task(library, task), scene=folder / f"{things}.ttl")

    @contextmanager
    def open(self, task: Task, folder: Path) -> Iterator[Opened]:
        with open_task(task, folder) as (cell, _, between):
            truth = RemoteTruth(folder / TRUTH, lambda: cell.now)
            yield Opened(cell, truth, lambda: between.ask("report")["violations"])


@contextmanager
def open_task(task: Task, folder: Path) -> Iterator[tuple[DeviceCell, Peer, Peer]]:
    """Open the cell of a task; yield it with the simulated robot and the proxy before it."""
    things = HERE / f"{task.scene.stem}.xml"
    (arm,) = read_scene_spec(task.state).arms
    with robot(things, float(arm.base.position[2]), folder / TRUTH) as simulated, proxy(simulated) as between:
        world = WorldModel(task.state.with_changes([SetProperty(arm.individual, DRIVER_ADDRESS, between.address)]))
        if things.stem == "desk":
            simulated.ask("wipe Desk-1 Eraser-1")
        with real_cell(world, simulated) as cell:
            yield cell, simulated, between


BODY = FrankaBody()
