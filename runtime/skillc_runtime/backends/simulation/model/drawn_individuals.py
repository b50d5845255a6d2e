"""The individuals that have bodies in the model of a scene."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import mujoco

from skillc_runtime.backends.simulation.names import base_body_name, part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.devices.drawing import DrawnIndividual


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
