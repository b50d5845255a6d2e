"""A cell of arms of Universal Robots, with their grippers and what is wired to their controllers."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import partial
from typing import Final, Literal, TypeAlias, assert_never, get_args

from skillc_runtime.backends.control_process.handshake import USUAL_PATIENCE, Patience
from skillc_runtime.backends.control_process.link import RobotLink
from skillc_runtime.backends.control_process.opening import open_cell
from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.devices.fingers import Fingers
from skillc_runtime.backends.devices.gripper_facts import open_gripper
from skillc_runtime.backends.real_time.device_cell import CellDevices, DeviceCell
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.backends.ur.facts import UrFacts, read_address, read_facts
from skillc_runtime.backends.ur.io import VOLTS, UrIo
from skillc_runtime.backends.ur.library import load_library
from skillc_runtime.devices.arm import NotOffered
from skillc_runtime.devices.backend import BackendStart, BackendUnavailable, DeviceStop, StopPersists, find_first_stop
from skillc_runtime.devices.sensors import Button, Camera, IoPoint
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import UR
from skillc_runtime.world.state.world_state import WorldState

Terminal: TypeAlias = Literal["digitalInput", "digitalOutput", "analogInput", "analogOutput", "speedSlider"]
TERMINALS: Final[tuple[Terminal, ...]] = get_args(Terminal)
"""What something is wired to, by the name of the property that says so."""


@dataclass(frozen=True, slots=True)
class UrDescription:
    """One arm, implementing `LinkDescription`."""

    facts: UrFacts

    @property
    def name(self) -> str:
        """The arm and its address."""
        return self.facts.name

    def make_link(self) -> RobotLink:
        """Return a link that is not connected; BackendUnavailable without ur-rtde."""
        for module in ("rtde_control", "rtde_receive"):
            load_library(module)
        from skillc_runtime.backends.ur.link import UrLink

        return UrLink(self.facts)


def make_backend(world: WorldModel, start: BackendStart) -> DeviceCell:
    """Return a cell of arms of Universal Robots; it is `MakeBackend`."""
    return open_arms(world, observed=start.observed)


def open_arms(
    world: WorldModel,
    patience: Patience = USUAL_PATIENCE,
    inspection: Camera | None = None,
    observed: bool = False,
) -> DeviceCell:
    """Return the cell of a world model; `inspection` is the camera that inspects surfaces, where there is one.

    With `observed` nothing is taken under control, and no gripper is activated.
    """
    state = world.snapshot()

    def describe(facts: ArmSpec) -> UrDescription:
        return UrDescription(read_facts(state, facts))

    def make_devices(scene: SceneSpec, arms: Mapping[str, RemoteArmDriver]) -> CellDevices:
        return replace(_open_devices(state, scene, arms, observed), inspection=inspection)

    return open_cell(world, describe, make_devices, patience, observed)


def _open_devices(
    state: WorldState, scene: SceneSpec, arms: Mapping[str, RemoteArmDriver], observed: bool
) -> CellDevices:
    """Connect to grippers, and to the inputs and outputs of the controller where something is wired to them."""
    with ExitStack() as opened:
        grippers: dict[str, Fingers] = {}
        for facts in scene.arms:
            if facts.gripper is None:
                continue
            arm, address = arms[facts.individual], read_address(state, facts.individual)
            let_go = partial(arm.set_load, None)
            fingers = open_gripper(state, facts.gripper, address, arm.hold, let_go, observed)
            opened.callback(fingers.close)
            grippers[facts.gripper.individual] = fingers
        wires = _read_wires(state)
        io = _open_io(state, scene, opened) if wires else None
        points = {} if io is None else {each: WiredPoint(io, wire) for each, wire in wires.items()}
        closing = opened.pop_all()

    watched: dict[str, Fingers | UrIo] = dict(grippers)
    if io is not None:
        watched[scene.arms[0].individual] = io

    def find_fault() -> DeviceStop | None:
        return find_first_stop((device, each.find_fault()) for device, each in watched.items())

    def recover() -> None:
        try:
            for each in watched.values():
                each.recover()
        except BackendUnavailable as error:
            raise StopPersists(str(error)) from error

    return CellDevices(
        grippers=grippers,
        buttons=points,
        io_points=points,
        find_fault=find_fault,
        recover=recover,
        close=closing.close,
    )


def _open_io(state: WorldState, scene: SceneSpec, opened: ExitStack) -> UrIo:
    if len(scene.arms) != 1:
        raise SheetError("to which controller something is wired is not known where a scene has several arms")
    arm = scene.arms[0].individual
    io = UrIo(state.vocabulary.short(arm), read_address(state, arm))
    opened.callback(io.close)
    return io


@dataclass(frozen=True, slots=True)
class Wire:
    """A terminal and its number; the speed slider has none."""

    terminal: Terminal
    number: int = 0


def _read_wires(state: WorldState) -> dict[str, Wire]:
    """Return what is wired to a controller, by IRI."""
    found: dict[str, Wire] = {}
    for individual in sorted(state.individuals):
        for terminal in TERMINALS:
            value = state.value(individual, UR + terminal)
            if isinstance(value, int) and value is not False:
                found[individual] = Wire(terminal, value)
    return found


class WiredPoint(IoPoint, Button):
    """An input or output of a controller; one that is on counts as a button that has switched."""

    def __init__(self, io: UrIo, wire: Wire) -> None:
        self._io, self._wire = io, wire

    @property
    def level(self) -> float:
        """The level that the controller reports: 0 or 1, V or A, or the share of all speeds."""
        io, number = self._io, self._wire.number
        match self._wire.terminal:
            case "digitalInput":
                return float(io.digital_input(number))
            case "digitalOutput":
                return float(io.digital_output(number))
            case "analogInput":
                return io.analog_input(number)
            case "analogOutput":
                return io.analog_output(number)
            case "speedSlider":
                return io.speed_share
            case _:
                assert_never(self._wire.terminal)

    def set(self, level: float) -> None:
        """Set an output; ValueError if it cannot have that level, NotOffered for an input, BackendBroken."""
        io, number = self._io, self._wire.number
        match self._wire.terminal:
            case "digitalOutput":
                _demand(level in (0.0, 1.0), "a digital output is set to 0 or 1", level)
                io.set_digital_output(number, level == 1.0)
            case "analogOutput":
                _demand(0.0 <= level <= VOLTS, f"an analogue output is set to 0 to {VOLTS:g} V", level)
                io.set_analog_output(number, level)
            case "speedSlider":
                _demand(0.0 < level <= 1.0, "the speed slider is set to a share above 0, up to 1", level)
                io.set_speed_share(level)
            case "digitalInput" | "analogInput":
                raise NotOffered("an input is not set")
            case _:
                assert_never(self._wire.terminal)

    @property
    def switched(self) -> bool:
        """Whether it is on."""
        return self.level > 0.0


def _demand(can_be: bool, what: str, level: float) -> None:
    if not can_be:
        raise ValueError(f"{what}, not to {level:g}")
