"""The things that hands can hold, by the models of their sheets: what a grasp tells the arm."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco

from skillc_runtime.backends.simulation.model.model_builder import build_model
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.variation.variation import exact_variation
from skillc_runtime.devices.arm import ArmLoad
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.working_face import working_face


@dataclass(frozen=True, slots=True)
class Thing:
    """A thing: its size (3,) in m, and its centre of mass (3,) in m in its own frame."""

    size: Array
    centre: Array

    def load(self, in_tool_centre: Pose, mass_kg: float) -> ArmLoad:
        """Return the load of an arm that holds it at a pose in the frame of the empty hand's tool centre point."""
        return ArmLoad(mass_kg, self.centre, in_tool_centre, in_tool_centre @ working_face(self.size))


def find_things(scene: SceneSpec) -> dict[str, Thing]:
    """Return the things of a scene that a hand can hold, by IRI."""
    model = build_model(scene, exact_variation(scene))
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    found = {}
    for each in scene.graspable:
        block = model.body(part_name(scene.names[each.individual], "block")).id
        place = Pose(data.xpos[block], data.xmat[block].reshape(3, 3))
        found[each.individual] = Thing(each.size, place.inverse().apply(data.subtree_com[block]))
    return found
