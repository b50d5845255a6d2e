"""Simulated inputs and outputs: outputs are as they are set, inputs as the scene states; nothing is wired to them."""

from __future__ import annotations

from skillc_runtime.devices.arm import NotOffered
from skillc_runtime.devices.sensors import IoPoint
from skillc_runtime.world.state.data_sheet import number_of
from skillc_runtime.world.state.terms import INPUT_POINT, LEVEL, OUTPUT_POINT
from skillc_runtime.world.state.world_state import WorldState


class SimulatedPoint(IoPoint):
    """An input or output of a simulated cell."""

    def __init__(self, level: float, is_output: bool) -> None:
        self._level, self._is_output = level, is_output

    @property
    def level(self) -> float:
        """The level that it has."""
        return self._level

    def set(self, level: float) -> None:
        """Set an output; NotOffered for an input."""
        if not self._is_output:
            raise NotOffered("an input is not set")
        self._level = level


def make_points(state: WorldState) -> dict[str, SimulatedPoint]:
    """Return the inputs and outputs of a scene, by IRI, at the levels that it states, or at 0."""
    outputs = state.instances(OUTPUT_POINT)
    both = outputs | state.instances(INPUT_POINT)
    return {each: SimulatedPoint(number_of(state, each, LEVEL, 0.0), each in outputs) for each in sorted(both)}
