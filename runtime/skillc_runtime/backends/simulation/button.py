"""Simulated buttons: whether they have switched, and the true forces on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.fixture_spec import FixtureSpec
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.steps import OnMemory
from skillc_runtime.backends.simulation.variation.fixture_variation import FixtureVariation
from skillc_runtime.motion.arrays import Vector
from skillc_runtime.motion.numerics.compiled import bind, compiled
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.data_sheet import SheetError


class ButtonSensor(msgspec.Struct, frozen=True):
    """force (1,): N, on a button."""

    force: Vector


@compiled
def feels_force(sensor: ButtonSensor, now: float) -> int:
    """Return 1 if there is a force on a button."""
    return 1 if sensor.force[0] > 0.0 else 0


class SimulatedButton(OnMemory):
    """A button of a simulated cell, implementing `Button`; its model has the sensors `travel` in m and `force` in N.

    Each step with a force is recorded.
    """

    def __init__(self, name: str, switches_at_m: float, data: Any) -> None:
        try:
            self._travel, self._force = (data.sensor(part_name(name, what)).data for what in ("travel", "force"))
        except KeyError as error:
            raise SheetError(f"the model of {name}, a button, needs the sensors `travel` and `force`") from error
        super().__init__(bind(feels_force, ButtonSensor(self._force)))
        self._switches_at, self._pressed = switches_at_m, list[tuple[float, float, float]]()

    @property
    def switched(self) -> bool:
        """Whether the cap is pressed in far enough."""
        return bool(self._travel[0] >= self._switches_at)

    @property
    def pressing(self) -> Array:
        """The steps (n, 3) with a force on the button: time in s, force in N, 1 if it had switched, else 0."""
        return np.array(self._pressed).reshape(-1, 3)

    def act(self, events: int, now: float) -> bool:
        """Record one step that began at `now` s."""
        self._pressed.append((now, float(self._force[0]), float(self.switched)))
        return False


def make_buttons(
    fixtures: Sequence[FixtureSpec], variations: Sequence[FixtureVariation], names: Mapping[str, str], data: Any
) -> dict[str, SimulatedButton]:
    """Return the buttons among the fixtures, by IRI."""
    return {
        each.individual: SimulatedButton(names[each.individual], each.switch_travel_m + true.switch_m, data)
        for each, true in zip(fixtures, variations, strict=True)
        if each.switch_travel_m is not None
    }
