"""Observes one held tool: records its true motion and forces, and updates the coverage of surfaces."""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt
from typing import Any

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.names import contact_sensor_name, face_sensor_name, pressing_sensor_name
from skillc_runtime.backends.simulation.scene_spec import ToolSpec
from skillc_runtime.backends.simulation.truth.recorder import (
    RecordedSteps,
    SampledReference,
    ToolRecorder,
    put_reference,
    record,
)
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.motion.arrays import OutMatrix, OutVector, Vector
from skillc_runtime.motion.coverage import CoverageMap, is_near, put_dose
from skillc_runtime.motion.numerics.compiled import bind, compiled, inlined
from skillc_runtime.motion.numerics.linear import rotation_of
from skillc_runtime.motion.numerics.program import Rows, join, row_of
from skillc_runtime.motion.pose import Array, Pose

STEPS_PER_UPDATE = 10
"""Number of steps between samples of coverage and reference: 100 Hz with steps of 1 ms."""


IS_FULL = 1
"""What an observer asks for: room for further steps."""


class Carrier(msgspec.Struct, frozen=True):
    """The driver of an arm that carries a tool, and the pose of its base in the world, whose arrays change."""

    driver: CompliantArmDriver
    base: Pose


@inlined
def update_peak(force: Array, square: Array) -> None:
    """Let square (1,) be at least that of the length of a force (3,) in N."""
    square[0] = max(square[0], force[0] * force[0] + force[1] * force[1] + force[2] * force[2])


class ObservedTool(msgspec.Struct, frozen=True):
    """What is observed of a tool in each step: force (3,): N, the sum of contact forces, and the greatest square of its
    length, square (1,). steps (1,): how many there were.
    """

    recorded: RecordedSteps
    force: Vector
    square: OutVector
    steps: OutVector


@compiled
def observe(tool: ObservedTool, now: float) -> int:
    """Observe one step that began at `now` s; return `IS_FULL`, and do nothing, if there is no room."""
    if not record(tool.recorded, now):
        return IS_FULL
    update_peak(tool.force, tool.square)
    tool.steps[0] += 1.0
    return 0


@inlined
def is_due(steps: Array) -> bool:
    """Tell whether coverage and reference are sampled in the step that is observed, of so many (1,)."""
    return bool((steps[0] - 1.0) % STEPS_PER_UPDATE == 0.0)


class PressedSurface(msgspec.Struct, frozen=True):
    """A surface that a tool may be pressed on.

    force (3,): N, of the tool on it; normal (3,), in the world; least_n: from where on the tool works; world: in the
    surface. dose (rows, columns), x (columns,), y (rows,): see `CoverageMap`. truth (11,): of the tool, size (2,) in m,
    half of its diagonal reach (1,) in m, period in s. greatest (1,): the greatest force on any surface, N; steps (1,).
    """

    force: Vector
    normal: Vector
    least_n: float
    world: Pose
    dose: OutMatrix
    x: Vector
    y: Vector
    truth: Vector
    size: Vector
    reach_m: float
    period: float
    greatest: OutVector
    steps: Vector


@compiled
def cover(surface: PressedSurface, now: float) -> int:
    """Update the coverage of a surface if it is due."""
    if not is_due(surface.steps):
        return 0
    force_n, truth, axes = 0.0, surface.truth, np.empty((3, 3))
    for i in range(3):
        force_n += surface.normal[i] * surface.force[i]
    force_n = abs(force_n)
    surface.greatest[0] = max(surface.greatest[0], force_n)
    x, y, world, place = surface.x, surface.y, surface.world, truth[1:4]
    if force_n >= surface.least_n and is_near(x, y, world, place, surface.reach_m):
        rotation_of(truth[4:8], axes)
        put_dose(surface.dose, x, y, world, place, axes, surface.size, surface.period)
    return 0


@compiled
def sample_tool_reference(sampled: SampledReference, now: float) -> int:
    """Sample the reference if it is due."""
    if is_due(sampled.steps):
        put_reference(sampled, now)
    return 0


class ToolObserver:
    """Samples one tool in each step, from the sensors at its working face and on surfaces.

    Whoever carries it is the `carrier`: the driver that moves it, and the arm's base in the world.
    """

    def __init__(
        self, facts: ToolSpec, names: Mapping[str, str], model: Any, data: Any, coverage: Mapping[str, CoverageMap]
    ) -> None:
        name = names[facts.individual]
        first = int(model.sensor(face_sensor_name(name, "touch")).adr[0])
        truth = data.sensordata[first : first + 11]
        self.recorder, self.peak_force, self._steps = ToolRecorder(truth), PeakForce(name, model, data), np.zeros(1)
        self._greatest = np.zeros(1)
        size, reach = np.array(facts.size[:2]), float(np.hypot(*facts.size[:2])) / 2
        rest = truth, size, reach, STEPS_PER_UPDATE * model.opt.timestep, self._greatest, self._steps
        self._cover = []
        for each, force in _pressing(name, names, model, data, coverage):
            of_map = each.normal, each.least_n, each.world, each.dose, each.x, each.y
            self._cover.append(bind(cover, PressedSurface(force, *of_map, *rest)))
        self._carrier: Carrier | None = None
        self._followed: Array | None = None
        self._bind()

    def rows(self, carrier: Carrier) -> Rows | None:
        """The functions that observe a step."""
        self._follow(carrier)
        return self._rows

    def sample(self, time: float, carrier: Carrier) -> None:
        """Sample one step that began at `time` s."""
        self._follow(carrier)
        if self._observe(time):
            self._bind()
            self._observe(time)
        for each in self._cover:
            each(time)
        self._sample_reference(time)

    def act(self, time: float, carrier: Carrier) -> bool:
        """Make room, and observe the step; it goes on with another memory."""
        self._bind()
        self.sample(time, carrier)
        return True

    def _follow(self, carrier: Carrier) -> None:
        if carrier is not self._carrier or carrier.driver.motion.live_rows[0] is not self._followed:
            self._carrier = carrier
            self._bind()

    def _bind(self) -> None:
        """Bind the functions to memory with room for further steps."""
        recorded, peak = self.recorder.make_memory(), self.peak_force
        tool = ObservedTool(recorded, peak.force, peak.square, self._steps)
        self._observe = bind(observe, tool)
        if self._carrier is not None:
            self._followed, path = self._carrier.driver.motion.live_rows
            of_steps = self._carrier.base, self._greatest, self._steps
            sampled = self.recorder.make_references(self._followed, path, *of_steps)
            self._sample_reference = bind(sample_tool_reference, sampled)
            self._rows = join(*map(row_of, (self._observe, *self._cover, self._sample_reference)))


class PeakForce:
    """The greatest length so far of the sum of contact forces on one tool that is held, N.

    force (3,): that of the last step; square (1,): the square of the greatest length.
    Contacts of the fingers are not included, since a weld holds the tool meanwhile.
    """

    def __init__(self, tool: str, model: Any, data: Any) -> None:
        """Observe the tool of a name in the model."""
        first = int(model.sensor(contact_sensor_name(tool)).adr[0])
        self.force = data.sensordata[first : first + 3]
        self.square: Array = np.zeros(1)

    @property
    def newton(self) -> float:
        """The greatest force so far in N."""
        return sqrt(self.square[0])

    def sample(self) -> None:
        """Sample one step."""
        update_peak(self.force, self.square)


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
