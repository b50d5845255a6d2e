"""How a simulated cell is drawn: its model, and its posture at an instant."""

from __future__ import annotations

from typing import Any

from skillc_runtime.backends.simulation.model.drawn_individuals import find_drawn
from skillc_runtime.backends.simulation.model.model_builder import describe_model
from skillc_runtime.backends.simulation.names import box_geom_name, part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.variation.variation import Variation
from skillc_runtime.devices.drawing import Posture


class ModelDrawing:
    """Implements `Drawing` for the model of a scene, `data` being its state."""

    def __init__(self, scene: SceneSpec, variation: Variation, model: Any, data: Any) -> None:
        self._scene, self._variation, self._data = scene, variation, data
        self.model = model
        arms = [arm.individual for arm in scene.arms]
        grippers = [arm.gripper.individual for arm in scene.arms if arm.gripper is not None]
        self.prefixes = {device: part_name(scene.names[device], "") for device in (*arms, *grippers)}
        present = (each.individual for each in scene.surfaces if variation.of(each.individual).present)
        self.surfaces = {each: box_geom_name(scene.names[each]) for each in present}

        there = {model.body(each).name for each in range(model.nbody)}
        self.individuals = {iri: each for iri, each in find_drawn(scene) if each.body in there}

    def posture(self) -> Posture:
        """Return a copy of the present posture."""
        data = self._data
        return Posture(data.qpos.copy(), data.mocap_pos.copy(), data.mocap_quat.copy())

    def describe_model(self) -> Any:
        """Return a new `mujoco.MjSpec` of the model, to be changed and compiled."""
        return describe_model(self._scene, self._variation)
