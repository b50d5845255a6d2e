"""Observes one held tool: records its true motion and forces, and updates the coverage of surfaces."""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt
from typing import Any

import numpy as np

from skillc_runtime.backends.simulation.names import contact_sensor_name, face_sensor_name, pressing_sensor_name
from skillc_runtime.backends.simulation.recorder import Recorder
from skillc_runtime.backends.simulation.scene_spec import ToolSpec
from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.pose import Array, rotation_from_quaternion

STEPS_PER_UPDATE = 10
"""Number of steps between samples of coverage and reference: 100 Hz with steps of 1 ms."""


class ToolObserver:
    """Samples one tool in each step, from the sensors at its working face and on surfaces."""

    def __init__(
        self, facts: ToolSpec, names: Mapping[str, str], model: Any, data: Any, coverage: Mapping[str, CoverageMap]
    ) -> None:
        name = names[facts.individual]
        self._extent = facts.size[:2]
        self._pressing = tuple(_pressing(name, names, model, data, coverage))
        first = int(model.sensor(face_sensor_name(name, "touch")).adr[0])
        self._truth = data.sensordata[first : first + 11]
        self._reach = float(np.hypot(*self._extent)) / 2
        self._seconds = STEPS_PER_UPDATE * model.opt.timestep
        self._steps = 0
        self.recorder, self.peak_force = Recorder(self._truth), PeakForce(name, model, data)

    def sample(self, time: float, driver: ArmDriver) -> None:
        """Sample one step that began at `time` s, in which `driver` moved the tool."""
        self.recorder.sample(time)
        self.peak_force.sample()
        if self._steps % STEPS_PER_UPDATE == 0:
            self.recorder.sample_reference(time, driver.motion.reference, driver.motion.path, self._update_coverage())
        self._steps += 1

    def _update_coverage(self) -> float:
        """Update the coverage; return the greatest force in N with which the tool presses on a surface."""
        greatest = 0.0
        for surface, force in self._pressing:
            force_n = abs(float(surface.normal @ force))
            greatest = max(greatest, force_n)
            if force_n >= surface.least_n and surface.near(self._truth[1:4], self._reach):
                surface.add(self._truth[1:4], rotation_from_quaternion(self._truth[4:8]), self._extent, self._seconds)
        return greatest


class PeakForce:
    """The greatest length so far of the sum of contact forces on one tool that is held, N.

    Contacts of the fingers are not included, since a weld holds the tool meanwhile.
    """

    def __init__(self, tool: str, model: Any, data: Any) -> None:
        """Observe the tool of a name in the model."""
        first = int(model.sensor(contact_sensor_name(tool)).adr[0])
        self._force = data.sensordata[first : first + 3]
        self._square = 0.0

    @property
    def newton(self) -> float:
        """The greatest force so far in N."""
        return sqrt(self._square)

    def sample(self) -> None:
        """Sample one step."""
        self._square = max(self._square, float(self._force.dot(self._force)))


def _pressing(
    tool: str, names: Mapping[str, str], model: Any, data: Any, coverage: Mapping[str, CoverageMap]
) -> list[tuple[CoverageMap, Array]]:
    """Return the surfaces that are present, each with a view (3,) of the force in N of the tool on it."""
    found = []
    for individual, surface in coverage.items():
        sensor = pressing_sensor_name(tool, names[individual])
        if any(model.sensor(each).name == sensor for each in range(model.nsensor)):
            first = int(model.sensor(sensor).adr[0])
            found.append((surface, data.sensordata[first : first + 3]))
    return found
