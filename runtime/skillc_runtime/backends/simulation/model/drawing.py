"""How a simulated cell is drawn: its model, and its posture at an instant."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import mujoco

from skillc_runtime.backends.simulation.model.model_builder import describe_model
from skillc_runtime.backends.simulation.names import base_body_name, box_geom_name, part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.variation.variation import Variation
from skillc_runtime.devices.drawing import DrawnIndividual, Posture
from skillc_runtime.vision.opencv import has_opencv


def find_drawn(scene: SceneSpec) -> Iterator[tuple[str, DrawnIndividual]]:
    """Yield the IRI of each individual of a scene, also of those that are not really there, and what is drawn of it."""
    names = scene.names
    for arm in scene.arms:
        name = names[arm.individual]
        yield arm.individual, DrawnIndividual(name, "arm", part_name(name, _root_of(arm.model)))
        if arm.gripper is not None:
            name = names[arm.gripper.individual]
            yield arm.gripper.individual, DrawnIndividual(name, "gripper", part_name(name, "palm"))
    for base in scene.bases:
        name = names[base.individual]
        yield base.individual, DrawnIndividual(name, "base", base_body_name(name))
    for tool in scene.tools:
        name = names[tool.individual]
        yield tool.individual, DrawnIndividual(name, "tool", part_name(name, "block"), movable=True)
    for surface in scene.surfaces:
        name = names[surface.individual]
        yield surface.individual, DrawnIndividual(name, "surface", name)
    for fixture in scene.fixtures:
        name = names[fixture.individual]
        yield fixture.individual, DrawnIndividual(name, "fixture", part_name(name, _root_of(fixture.model)))
    for body in scene.bodies:
        name = names[body.individual]
        part = part_name(name, "block") if body.movable else name
        yield body.individual, DrawnIndividual(name, "body", part, movable=body.movable)


def _root_of(model: Path) -> str:
    """Return the name of the first body of a device's own model."""
    return str(mujoco.MjSpec.from_file(str(model)).worldbody.first_body().name)


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
        """Return a new `mujoco.MjSpec` of the model with the faces of parts, to be changed and compiled."""
        described, camera = describe_model(self._scene, self._variation), self._scene.image_camera
        if camera is not None and camera.parts and has_opencv():
            # Few cells have one, and what draws for it takes a while to import.
            from skillc_runtime.backends.simulation.cameras.part_faces import draw_faces
            from skillc_runtime.backends.simulation.cameras.photo_model import add_faces

            faces = draw_faces(camera.parts, self._variation.seed)
            add_faces(described, faces, self._scene.names, camera.parts)
        return described
