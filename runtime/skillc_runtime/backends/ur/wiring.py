"""What is wired to the inputs and outputs of a controller, by the facts of a scene."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Literal, TypeAlias, assert_never, get_args

from skillc_runtime.backends.ur.io import VOLTS, UrIo
from skillc_runtime.devices.arm import NotOffered
from skillc_runtime.devices.sensors import Button, IoPoint
from skillc_runtime.world.state.terms import UR
from skillc_runtime.world.state.world_state import WorldState

Terminal: TypeAlias = Literal["digitalInput", "digitalOutput", "analogInput", "analogOutput", "speedSlider"]
TERMINALS: Final[tuple[Terminal, ...]] = get_args(Terminal)
"""What something is wired to, by the name of the property that says so."""


@dataclass(frozen=True, slots=True)
class Wire:
    """A terminal and its number; the speed slider has none."""

    terminal: Terminal
    number: int = 0


def read_wires(state: WorldState) -> dict[str, Wire]:
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
