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
    part_name,
    pressing_sensor_name,
)
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.motion.pose import Array


class ContactSensors:
    """The touch and contact sensors of a cell. A tool's row: its force on its face, on all things, on each surface."""

    def __init__(self, scene: SceneSpec, forces: Forces, model: Any, data: Any) -> None:
        self._on_geom = forces.on_geom.reshape(-1, model.ngeom, 3)
        self._forces, self._values = forces, data.sensordata
        addresses = {model.sensor(each).name: int(model.sensor(each).adr[0]) for each in range(model.nsensor)}
        names = scene.names
        self._tools = {t.individual: _Tool(scene, names[t.individual], addresses, model) for t in scene.tools}
        fixtures = tuple(part_name(names[each.individual], "") for each in scene.fixtures)
        self._fixtures = [
            (addresses[name], np.flatnonzero(model.geom_bodyid == model.site_bodyid[model.sensor(name).objid[0]]))
            for name in addresses
            if model.sensor(name).type[0] == mujoco.mjtSensor.mjSENS_TOUCH and fixtures and name.startswith(fixtures)
        ]

    def update(self, held: Sequence[str | None]) -> None:
        """Write the forces on the tools that arms hold, in the order of arms, and on all fixtures."""
        on_geom, values, forces = self._on_geom, self._values, self._forces
        for address, geoms in self._fixtures:
            values[address] = np.linalg.norm(on_geom[:, geoms].sum(axis=(0, 1)))
        for number, tool in enumerate(held):
            if tool in self._tools:
                carrier = 2 * number + TOOL
                self._tools[tool].update(values, on_geom[carrier], forces.net[carrier], forces.total[carrier])


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

    def update(self, values: Array, on_geom: Array, net: Array, total_n: float) -> None:
        """Write the forces of the tool in N: on each geom (geoms, 3), on all (3,), and the sum of normal forces."""
        values[self._touch] = total_n
        values[self._contact : self._contact + 3] = net
        for address, geom in self._surfaces:
            values[address : address + 3] = on_geom[geom]
