"""The link to an arm that stays at home, with no robot behind it: for what concerns the processes alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skillc_runtime.backends.control_process.link import (
    CommandView,
    DeviceCondition,
    LinkAbilities,
    LinkMode,
    PointMass,
    StateView,
)
from skillc_runtime.backends.control_process.periods.pacing import Pacer

PERIOD_S = 0.001


@dataclass(frozen=True)
class StillDescription:
    """A device that stays at home."""

    home: tuple[float, ...]
    abilities: LinkAbilities
    name: str = "a device that stays at home"

    def make_link(self) -> StillLink:
        return StillLink(self)


class StillLink:
    """Implements `RobotLink` without a device."""

    period_s = PERIOD_S

    def __init__(self, description: StillDescription) -> None:
        self._home, self.abilities = np.array(description.home), description.abilities
        self.condition = DeviceCondition("ready")

    def connect(self) -> None:
        self._pacer, self._stamp_s = Pacer(PERIOD_S), 0.0

    def read(self, state: StateView) -> None:
        self._pacer.wait()
        self._stamp_s += PERIOD_S
        state.buffer[:], state.speed_share[0], state.stamp_s[0] = 0.0, 1.0, self._stamp_s
        state.q[:] = state.target[:] = self._home

    def write(self, command: CommandView) -> None:
        pass

    def take_control(self, mode: LinkMode) -> None:
        self.condition = DeviceCondition("in-control")

    def give_back(self) -> None:
        self.condition = DeviceCondition("ready")

    def recover(self) -> None:
        pass

    def set_load(self, hand: PointMass, held: PointMass) -> None:
        pass

    def tare(self) -> None:
        pass

    def close(self) -> None:
        pass
