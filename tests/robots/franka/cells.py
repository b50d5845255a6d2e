"""Cells of the robot that others simulate, and tasks that are carried out in them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import cache
from pathlib import Path

from robots.franka.running import Peer
from robots.franka.things import SWITCHES_M
from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.control_process.handshake import Patience
from skillc_runtime.backends.control_process.opening import open_cell
from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.franka.cell import describe, make_devices
from skillc_runtime.backends.real_time.device_cell import CellDevices, DeviceCell
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.devices.backend import StopPersists
from skillc_runtime.devices.sensors import Camera
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.events import Listener
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

LAB = "http://example.org/lab#"
ARM = LAB + "Arm-1"
LOOKED_S = 0.2
"""A cell has looked at its devices after this time."""

PATIENCE = Patience(tree_s=3.0, process_s=3.0, gap_s=3.0)
"""Machines that run tests are busy with others."""


@cache
def library(name: str) -> SkillLibrary:
    """Return a shipped library."""
    outcome = libraries.compile_library(find_library(SHIPPED / name))
    assert outcome.ok
    return outcome.value


def write_scene(library_name: str, task_name: str, file: Path, facts: str = "") -> None:
    """Write the scene of a shipped task of the Panda, its arm being a Franka Research 3, with facts of it."""
    task = library(library_name).tasks[task_name]
    assert task.scene is not None
    shipped = SHIPPED / library_name / task.scene
    text = (shipped if shipped.exists() else catalogue.scene_path(task.scene)).read_text("utf-8")
    text = text.replace("skillc:Panda ;", f"skillc:Fr3 ; {facts}")
    file.write_text(text.replace("skillc:panda-sheet", "skillc:fr3-sheet"), "utf-8")


def own_scene(library_name: str, task_name: str, address: str, folder: Path) -> WorldModel:
    """Return the world of a shipped task of the Panda, whose arm is a Franka Research 3 at an address."""
    write_scene(library_name, task_name, folder / "cell.ttl", f'skiros:DriverAddress "{address}" ;')
    return WorldModel(load_scene(folder / "cell.ttl", library(library_name).vocabulary))


class PeersCamera(Camera):
    """A camera that sees what the peer's things have wiped."""

    def __init__(self, peer: Peer) -> None:
        self._peer = peer

    def inspect(self, surface: str) -> float:
        """Return the share that is clean."""
        return float(self._peer.ask("wiped"))

    def rubbed_share(self, surface: str, seconds: float) -> float:
        """Return the same: how long is not seen."""
        return self.inspect(surface)


class PeersButton:
    """A button of a peer's that switches where its data sheet says."""

    def __init__(self, peer: Peer) -> None:
        self._peer = peer

    @property
    def switched(self) -> bool:
        """Whether it is pressed so far that it has switched."""
        return float(self._peer.ask("travel cap")) >= SWITCHES_M


@contextmanager
def real_cell(world: WorldModel, peer: Peer | None = None) -> Iterator[DeviceCell]:
    """Open the cell of a world, with a camera and buttons that see a peer's things, and close it."""

    def devices(scene: SceneSpec, arms: Mapping[str, RemoteArmDriver]) -> CellDevices:
        own = make_devices(scene, arms)
        if peer is None:
            return own
        buttons = {each.individual: PeersButton(peer) for each in scene.fixtures}
        return replace(own, inspection=PeersCamera(peer), buttons=buttons)

    cell = open_cell(world, describe, devices, PATIENCE)
    try:
        yield cell
    finally:
        cell.close()


def carry_out(
    library_name: str, task_name: str, cell: DeviceCell, listeners: tuple[Listener, ...] = ()
) -> Execution[DeviceCell]:
    """Carry out a task with a goal."""
    compiled = library(library_name)
    goal = compiled.tasks[task_name].goal
    assert goal is not None
    prepared = prepare_task(Assignment(task_name, cell.world.snapshot(), AchieveGoal(goal)), compiled)
    assert isinstance(prepared, PreparedTask), prepared
    return execute_task(prepared, compiled, cell, listeners)


def begin_to_move(cell: DeviceCell) -> None:
    """Begin a slow motion of all joints."""
    q = cell.arm(ARM).measured.q
    cell.arm(ARM).motion.move_joints(q + (0.3 if q[0] < 0.15 else -0.3), 0.1)
    cell.advance(0.5)


def is_cleared(cell: DeviceCell) -> bool:
    """Acknowledge a stop, such as that of an arm that still moved when it was taken; tell whether none is left."""
    with suppress(StopPersists):
        cell.stops.clear()
    return cell.stops.report is None
