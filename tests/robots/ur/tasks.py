"""Runs shipped tasks in cells of an emulated arm, with the peer's own judgement of what was done."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from robots.ur.emulator.grippers import WSG_PORT
from robots.ur.peer import Peer
from skillc.services.library import libraries
from skillc.services.library.files import find_library
from skillc.services.tasks.assignments import assign_call
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.control_process.handshake import Patience
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.backends.ur.cell import open_arms
from skillc_runtime.devices.sensors import Camera
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.events import Listener
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import Change, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DRIVER_ADDRESS, STATE_TIMEOUT, UR
from skillc_runtime.world.state.world_state import WorldState

LAB = "http://example.org/lab#"
ARM, HAND, BUTTON, BOARD = LAB + "Ur5e-1", LAB + "Wsg-1", LAB + "Button-1", LAB + "Whiteboard-1"
HERE = Path(__file__).parent
PATIENCE = Patience(tree_s=5.0, process_s=5.0, gap_s=5.0)
BUTTON_INPUT = 3
PATIENT = ("--patience", "0.2", "--button", str(BUTTON_INPUT))


class PeerCamera(Camera):
    """A camera that asks the peer how clean its surfaces really are."""

    def __init__(self, peer: Peer) -> None:
        self._peer = peer

    def inspect(self, surface: str) -> float:
        """Return the share of a surface that is clean."""
        return float(self._peer.do("inspect", surface=surface))

    def rubbed_share(self, surface: str, seconds: float) -> float:
        """Return the share of a surface that was rubbed for at least `seconds`."""
        return float(self._peer.do("rubbed", surface=surface, seconds=seconds))


def compiled(path: Path) -> SkillLibrary:
    """Return a library."""
    outcome = libraries.compile_library(find_library(path))
    assert outcome.ok, outcome.diagnostics
    return outcome.value


def facts_of(peer: Peer) -> list[Change]:
    """Return what a scene has to say of a peer; time-outs are long, for machines that are busy."""
    return [
        SetProperty(ARM, DRIVER_ADDRESS, peer.host),
        SetProperty(ARM, STATE_TIMEOUT, 2.5),
        SetProperty(ARM, UR + "commandTimeout", 1.0),
        SetProperty(HAND, DRIVER_ADDRESS, f"{peer.host}:{WSG_PORT}"),
    ]


def scene_of(peer: Peer, scene: Path, library: SkillLibrary, changes: Sequence[Change] = ()) -> WorldState:
    """Return a scene with the facts of a peer."""
    return with_peer(peer, load_scene(scene, library.vocabulary).with_changes(changes))


def with_peer(peer: Peer, state: WorldState) -> WorldState:
    """Return a state of the world with the facts of a peer."""
    wired = [SetProperty(BUTTON, UR + "digitalInput", BUTTON_INPUT)] if BUTTON in state.individuals else []
    return state.with_changes([*facts_of(peer), *wired])


@contextmanager
def opened(peer: Peer, state: WorldState, patience: Patience = PATIENCE) -> Iterator[DeviceCell]:
    """Open the cell of a state of the world."""
    cell = open_arms(WorldModel(state), patience, PeerCamera(peer))
    try:
        yield cell
    finally:
        cell.close()


def run_goal(
    cell: DeviceCell, state: WorldState, library: SkillLibrary, goal: Condition, listeners: Sequence[Listener] = ()
) -> Execution[DeviceCell]:
    """Plan for a goal, and run that to its end."""
    return _run(cell, library, Assignment("task", state, AchieveGoal(goal)), listeners)


def run_call(cell: DeviceCell, state: WorldState, library: SkillLibrary, call: str) -> Execution[DeviceCell]:
    """Run a call of a skill, in the words of the language, to its end."""
    return _run(cell, library, assign_call(call, library, state), ())


def _run(
    cell: DeviceCell, library: SkillLibrary, assignment: Assignment, listeners: Sequence[Listener]
) -> Execution[DeviceCell]:
    prepared = prepare_task(assignment, library)
    assert isinstance(prepared, PreparedTask), prepared
    return execute_task(prepared, library, cell, listeners)
