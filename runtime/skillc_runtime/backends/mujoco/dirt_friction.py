"""Lets dirt change how a surface rubs: under a tool, the friction is that of what the tool lies on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from skillc_runtime.backends.mujoco.physics import Physics
from skillc_runtime.backends.simulation.names import box_geom_name, face_sensor_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec, SurfaceSpec, ToolSpec
from skillc_runtime.backends.simulation.steps import Due, OnMemory, is_due
from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.numerics.compiled import bind
from skillc_runtime.motion.numerics.linear import rotation_of
from skillc_runtime.motion.pose import Array

PERIOD_S = 0.01
"""Time between two updates of the friction, in which a tool moves a millimetre or two."""


class DirtFriction:
    """The friction of surfaces that state how dirt rubs, updated 100 times a second.

    Coulomb friction whose coefficient is the mean over the face of the tool that lies on the surface: that of the
    clean surface, times `1 - (1 - share) a` where a cell has the amount of dirt a, from 0 to 1 (`CoverageMap.dirt`).
    """

    def __init__(self, scene: SceneSpec, physics: Physics, coverage: Mapping[str, CoverageMap]) -> None:
        self._physics, model = physics, physics.model
        self._faces = [(tool, _face_of(tool, scene, physics)) for tool in scene.tools]
        self._surfaces = []
        for each in scene.surfaces:
            geom = _find_geom(model, box_geom_name(scene.names[each.individual]))
            if each.dirt_friction != 1.0 and geom is not None:
                self._surfaces.append((each, coverage[each.individual], geom, float(model.geom_friction[geom, 0])))
        self._due = np.zeros(1)

    def parts(self) -> Iterator[OnMemory]:
        """Yield what updates the friction; nothing if no surface states how its dirt rubs."""
        if self._surfaces:
            yield OnMemory(bind(is_due, Due(self._due)), self._update)

    def _update(self, events: int, now: float) -> bool:
        self._due[0] = now + PERIOD_S
        for surface, covered, geom, clean in self._surfaces:
            amount = max((self._find_amount(surface, covered, *each) for each in self._faces), default=0.0)
            self._physics.set_friction(geom, clean * (1.0 - (1.0 - surface.dirt_friction) * amount))
        return False

    def _find_amount(self, surface: SurfaceSpec, covered: CoverageMap, tool: ToolSpec, truth: Array) -> float:
        """Return the mean amount of dirt under the face of a tool; 0 where it is not over the surface."""
        axes = np.empty((3, 3))
        rotation_of(truth[4:8], axes)
        under = covered.find_under(truth[1:4], axes, np.array(tool.size[:2]))
        return float(covered.find_dirt(surface.removal_s)[under].mean()) if under.any() else 0.0


def _find_geom(model: Any, name: str) -> int | None:
    """Return the number of a geom; None if the model, in which a surface may be absent, has none of that name."""
    return next((each for each in range(model.ngeom) if model.geom(each).name == name), None)


def _face_of(tool: ToolSpec, scene: SceneSpec, physics: Physics) -> Array:
    """Return where the sensors of a tool's face write time, place and turn: touch (1,), place (3,), quaternion (4,)."""
    first = int(physics.model.sensor(face_sensor_name(scene.names[tool.individual], "touch")).adr[0])
    view: Array = physics.data.sensordata[first : first + 8]
    return view
