"""The link to a toy robot, its fingers and its camera: what a back end for it implements."""

from __future__ import annotations

import socket
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing.connection import Client
from pathlib import Path
from threading import Lock
from typing import Any

import numpy as np

from control_process.toy_robot import COMMAND, CONDITIONS, GIVE, LOAD, RECOVER, TAKE
from simulation.cells import LAB, world
from skillc_runtime.backends.control_process.handshake import Patience
from skillc_runtime.backends.control_process.link import (
    KINDS,
    CommandView,
    ConditionKind,
    ControlRefused,
    DeviceCondition,
    LinkAbilities,
    LinkLost,
    LinkMode,
    PointMass,
    RobotLink,
    StateView,
)
from skillc_runtime.backends.control_process.opening import open_cell
from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.real_time.device_cell import CellDevices, DeviceCell
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.devices.backend import BackendBroken, BackendUnavailable, StopPersists
from skillc_runtime.devices.gripper import CLOSED_FURTHER_M
from skillc_runtime.devices.sensors import Camera
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import AT
from skillc_runtime.world.state.world_state import WorldState

PATIENCE = Patience(tree_s=4.0, process_s=4.0, gap_s=3.0)
"""Machines that run tests are busy with others."""

MUCH_PATIENCE = Patience(tree_s=60.0, process_s=60.0, gap_s=60.0)
"""For tests in which nothing falls silent."""

SAYS = {
    "not-in-control": "the panel of the toy has control; press Release on it",
    "wrong-mode": "the toy is in its manual mode; turn the key",
    "protective-stop": "the toy has stopped by itself",
    "emergency-stop": "the emergency stop of the toy is pressed; release it",
}
CONDITION = [DeviceCondition(kind, SAYS.get(kind, "")) for kind in CONDITIONS]  # type: ignore[arg-type]


@dataclass(frozen=True)
class ToyDescription:
    """Where a toy robot listens, and what it can do."""

    port: int
    joints: int
    abilities: LinkAbilities
    period_s: float

    @property
    def name(self) -> str:
        return f"the toy robot at port {self.port}"

    def make_link(self) -> RobotLink:
        return ToyLink(self)


class ToyLink:
    """Speaks the protocol of `toy_robot`."""

    def __init__(self, description: ToyDescription) -> None:
        self._there, self.period_s, self.abilities = description, description.period_s, description.abilities
        self._stream: socket.socket | None = None
        self._size, self.condition = 8 * (2 + 4 * description.joints + 6), CONDITION[0]

    def connect(self) -> None:
        self.close()
        try:
            self._stream = socket.create_connection(("127.0.0.1", self._there.port), 1.0)
        except OSError as error:
            raise BackendUnavailable(f"{self._there.name} does not answer: {error}; start it") from error
        self._stream.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._stream.settimeout(self.abilities.silence_s)

    def read(self, state: StateView) -> None:
        frame = self._receive()
        joints = self._there.joints
        self.condition = CONDITION[int(frame[1])]
        state.stamp_s[0], state.speed_share[0] = frame[0], 1.0
        q, dq, target, effort = frame[2 : 2 + 4 * joints].reshape(4, joints)
        state.q[:], state.dq[:], state.target[:], state.effort[:] = q, dq, target, effort
        state.wrench[:] = frame[-6:]

    def write(self, command: CommandView) -> None:
        self._send(COMMAND, command.kind[0], command.values)

    def take_control(self, mode: LinkMode) -> None:
        self._ask(TAKE, KINDS.index(mode), "in-control")

    def give_back(self) -> None:
        self._send(GIVE, 0.0, np.zeros(self._there.joints))
        self.condition = CONDITION[0]

    def recover(self) -> None:
        if self.condition.kind in ("ready", "in-control"):
            return
        try:
            self._ask(RECOVER, 0.0, "ready")
        except ControlRefused as refusal:
            raise StopPersists(str(refusal)) from refusal

    def set_load(self, hand: PointMass, held: PointMass) -> None:
        self._send(LOAD, held.mass_kg, np.concatenate([held.centre, np.zeros(self._there.joints - 3)]))

    def tare(self) -> None:
        raise AssertionError("the abilities do not say so")

    def close(self) -> None:
        if self._stream is not None:
            self._stream.close()
            self._stream = None

    def _ask(self, operation: int, value: float, kind: ConditionKind) -> None:
        """Send a request and wait for its condition; ControlRefused if it does not come."""
        self._send(operation, value, np.zeros(self._there.joints))
        for _ in range(5000):  # States that were sent before wait in the stream.
            self.condition = CONDITION[int(self._receive()[1])]
            if self.condition.kind == kind:
                return
            if self.condition.kind not in ("ready", "protective-stop"):
                break
        raise ControlRefused(self.condition.sentence or "the toy does not answer the request")

    def _send(self, operation: int, value: float, values: Any) -> None:
        assert self._stream is not None
        try:
            self._stream.sendall(np.concatenate([[operation, value], values]).tobytes())
        except OSError as error:
            raise LinkLost(f"{self._there.name} does not take commands any more: {error}") from error

    def _receive(self) -> Any:
        assert self._stream is not None
        data = b""
        try:
            while len(data) < self._size:
                if not (more := self._stream.recv(self._size - len(data))):
                    raise LinkLost(f"{self._there.name} has closed the connection")
                data += more
        except TimeoutError as error:
            silence_s = self.abilities.silence_s
            raise LinkLost(f"{self._there.name} has been silent for {silence_s:g} s") from error
        except OSError as error:
            raise LinkLost(f"{self._there.name} is not there any more: {error}") from error
        return np.frombuffer(data)


class Toy:
    """A running toy robot; `ask` calls its panel. `running` are the ports of one that somebody else has started.

    `truth` is the socket where it tells what is true.
    """

    def __init__(
        self, scene: str, paced: bool = False, running: tuple[int, int] | None = None, truth: Path | None = None
    ) -> None:
        self.scene, self._turn = scene, Lock()
        if running is None:
            self._start(scene, paced, truth)
        else:
            self.port, self.panel_port = running
        self._panel = Client(("127.0.0.1", self.panel_port))

    def _start(self, scene: str, paced: bool, truth: Path | None) -> None:
        command = [sys.executable, "-m", "control_process.toy_robot", scene, "paced" if paced else "patient"]
        command += [] if truth is None else [str(truth)]
        tests = Path(__file__).parent.parent
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=tests, env=_with_path())
        assert self.process.stdout is not None
        self.port, self.panel_port = map(int, self.process.stdout.readline().split())

    def ask(self, name: str, *arguments: Any) -> Any:
        """Return what a call of the panel returns; BackendBroken if there is no answer."""
        with self._turn:
            return self._ask(name, *arguments)

    def _ask(self, name: str, *arguments: Any) -> Any:
        try:
            if self._panel.closed:
                self._panel = Client(("127.0.0.1", self.panel_port))
            self._panel.send((name, arguments))
            if self._panel.poll(PATIENCE.tree_s):
                return self._panel.recv()
        except (EOFError, OSError) as error:
            raise BackendBroken("the panel of the toy is not there any more") from error
        self._panel.close()
        raise BackendBroken("the panel of the toy does not answer")

    def describe(self, facts: Any) -> ToyDescription:
        modes = facts.modes
        abilities = LinkAbilities(
            modes, wrench="without-weight" if facts.force_torque else "none", measures_effort=True, silence_s=2.0
        )
        return ToyDescription(self.port, facts.home.size, abilities, 0.001)

    def open(self, state: WorldState | None = None, patience: Patience = PATIENCE) -> DeviceCell:
        """Open its cell with a state of the world; by default with that of its scene."""
        return self.open_world(self.world() if state is None else WorldModel(state), patience)

    def open_world(self, world: WorldModel, patience: Patience = PATIENCE, observed: bool = False) -> DeviceCell:
        """Open its cell."""
        return open_cell(world, self.describe, self._make_devices, patience, observed)

    def world(self) -> WorldModel:
        moved = [AddRelation(LAB + "Heron-1", AT, LAB + "Store")] if self.scene == "ur5e_whiteboard" else []
        return WorldModel(world(self.scene).with_changes(moved))

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        with suppress(OSError):
            self._panel.close()

    def _make_devices(self, scene: SceneSpec, arms: Mapping[str, RemoteArmDriver]) -> CellDevices:
        hands = {
            each.gripper.individual: ToyGripper(self, each.gripper, arms[each.individual])
            for each in scene.arms
            if each.gripper is not None
        }
        buttons = {each.individual: ToyButton(self, each.individual) for each in scene.fixtures}
        return CellDevices(grippers=hands, buttons=buttons, inspection=ToyCamera(self))


class ToyGripper:
    """The fingers of a toy robot."""

    def __init__(self, toy: Toy, facts: Any, arm: RemoteArmDriver) -> None:
        self._toy, self._arm, self._thing, self._held_at_m = toy, arm, "", 0.0
        self.max_opening_m, self.max_force_n, self.opening_error_m = facts.max_opening_m, facts.max_force_n, 1e-3

    @property
    def opening_m(self) -> float:
        return float(self._toy.ask("fingers")[0])

    @property
    def moving(self) -> bool:
        return bool(self._toy.ask("fingers")[1])

    @property
    def blocked(self) -> bool:
        return bool(self._toy.ask("fingers")[2])

    def move(self, opening_m: float, force_n: float) -> None:
        self._toy.ask("move_fingers", opening_m, force_n)

    def stop(self) -> None:
        self._toy.ask("stop_fingers")

    def attach(self, thing: str, in_tool_centre: Pose, mass_kg: float) -> None:
        if not self.blocked:
            raise RuntimeError("nothing keeps the fingers from closing")
        self._thing, self._held_at_m = thing, self.opening_m
        self._arm.hold(thing, in_tool_centre, mass_kg, self._held_at_m)

    def detach(self) -> None:
        if self._thing:
            self._thing = ""
            self._arm.set_load(None)

    @property
    def holding(self) -> str | None:
        closed = self._thing and self.opening_m < self._held_at_m - CLOSED_FURTHER_M
        return None if closed or not self._thing else self._thing


class ToyButton:
    """A button beside a toy robot."""

    def __init__(self, toy: Toy, individual: str) -> None:
        self._toy, self._individual = toy, individual

    @property
    def switched(self) -> bool:
        return bool(self._toy.ask("switched", self._individual))


class ToyCamera(Camera):
    """The camera of a toy robot."""

    def __init__(self, toy: Toy) -> None:
        self._toy = toy

    def inspect(self, surface: str) -> float:
        return self.rubbed_share(surface, 0.0)

    def rubbed_share(self, surface: str, seconds: float) -> float:
        return float(self._toy.ask("rubbed_share", surface, seconds))


@contextmanager
def toy_cell(
    scene: str,
    paced: bool = False,
    state: WorldState | None = None,
    patience: Patience = PATIENCE,
    truth: Path | None = None,
) -> Iterator[tuple[Toy, DeviceCell]]:
    """Yield a toy robot and its cell."""
    toy = Toy(scene, paced, truth=truth)
    try:
        cell = toy.open(state, patience)
        try:
            yield toy, cell
        finally:
            cell.close()
    finally:
        toy.close()


def _with_path() -> dict[str, str]:
    import os

    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
