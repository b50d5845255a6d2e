"""Writes what touches tools and fixtures to the sensors of the model that physics would write."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.kinematic.contact import TOOL, Forces
from skillc_runtime.backends.simulation.names import (
    box_geom_name,
    contact_sensor_name,
    face_sensor_name,
    pressing_sensor_name,
)
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.motion.pose import Array


class ContactSensors:
    """The touch and contact sensors of a cell. A tool's row: its force on its face, on all things, on each surface."""

    def __init__(self, scene: SceneSpec, forces: Forces, model: Any, data: Any) -> None:
        self._on_geom = forces.on_geom.reshape(-1, model.ngeom, 3)
        self._total, self._values = forces.total, data.sensordata
        addresses = {model.sensor(each).name: int(model.sensor(each).adr[0]) for each in range(model.nsensor)}
        self._tools = {
            each.individual: _Tool(scene, scene.names[each.individual], addresses, model) for each in scene.tools
        }
        self._fixtures = [
            (address, np.flatnonzero(model.geom_bodyid == model.site_bodyid[model.sensor_objid[sensor]]))
            for sensor in range(model.nsensor)
            for address in (int(model.sensor_adr[sensor]),)
            if model.sensor_type[sensor] == mujoco.mjtSensor.mjSENS_TOUCH
        ]

    def update(self, held: Sequence[str | None]) -> None:
        """Write the forces on the tools that arms hold, in the order of arms, and on all fixtures."""
        on_geom, values = self._on_geom, self._values
        for address, geoms in self._fixtures:
            values[address] = np.linalg.norm(on_geom[:, geoms].sum(axis=(0, 1)))
        for number, tool in enumerate(held):
            if tool is not None:
                self._tools[tool].update(values, on_geom[2 * number + TOOL], self._total[2 * number + TOOL])


class _Tool:
    """The sensors of one tool."""

    def __init__(self, scene: SceneSpec, name: str, addresses: dict[str, int], model: Any) -> None:
        self._touch = addresses[face_sensor_name(name, "touch")]
        self._contact = addresses[contact_sensor_name(name)]
        self._surfaces = [
            (addresses[sensor], model.geom(box_geom_name(surface)).id)
            for surface in (scene.names[each.individual] for each in scene.surfaces)
            if (sensor := pressing_sensor_name(name, surface)) in addresses
        ]

    def update(self, values: Array, on_geom: Array, total_n: float) -> None:
        """Write the forces of the tool: on_geom (geoms, 3) on each geom, N, and the sum of normal forces."""
        values[self._touch] = total_n
        values[self._contact : self._contact + 3] = on_geom.sum(axis=0)
        for address, geom in self._surfaces:
            values[address : address + 3] = on_geom[geom]
