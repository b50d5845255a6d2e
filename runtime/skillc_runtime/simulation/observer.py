"""Watches one held tool: records what really happens to it and keeps the coverage of surfaces up to date."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from skillc_runtime.motion.pose import rotation_of
from skillc_runtime.robots.driver import ArmDriver
from skillc_runtime.simulation.coverage import PRESSED_N, CoverageMap
from skillc_runtime.simulation.facts import ToolFacts
from skillc_runtime.simulation.names import face_sensor
from skillc_runtime.simulation.recorder import Recorder
from skillc_runtime.simulation.strongest import StrongestForce

STEPS_PER_UPDATE = 10
"""Coverage and reference are looked at every so many steps: at 100 Hz with steps of 1 ms."""


class ToolObserver:
    """Looks at one tool once a step, from the sensors at its working face."""

    def __init__(self, facts: ToolFacts, name: str, model: Any, data: Any, coverage: Mapping[str, CoverageMap]) -> None:
        self._extent, self._coverage = facts.size[:2], coverage
        first = int(model.sensor(face_sensor(name, "touch")).adr[0])
        self._truth = data.sensordata[first : first + 11]
        self._reach = float(np.hypot(*self._extent)) / 2
        self._seconds = STEPS_PER_UPDATE * model.opt.timestep
        self._steps = 0
        self.recorder, self.strongest = Recorder(self._truth), StrongestForce(name, model, data)

    def sample(self, time: float, driver: ArmDriver) -> None:
        """Take in one step that began at `time` s, in which `driver` moved the tool."""
        self.recorder.sample(time)
        self.strongest.sample()
        if self._steps % STEPS_PER_UPDATE == 0:
            self.recorder.sample_reference(time, driver.reference, driver.path)
            if self._truth[0] > PRESSED_N:
                self._cover()
        self._steps += 1

    def _cover(self) -> None:
        position, rotation = self._truth[1:4], rotation_of(self._truth[4:8])
        for surface in self._coverage.values():
            if surface.near(position, self._reach):
                surface.add(position, rotation, self._extent, self._seconds)
