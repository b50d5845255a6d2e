"""The model of a cell of real devices, its arms where they are measured: what displays draw."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import mujoco

from skillc_runtime.backends.control_process.fingers import find_fingers
from skillc_runtime.backends.simulation.drawing import ModelDrawing
from skillc_runtime.backends.simulation.model_builder import build_model
from skillc_runtime.backends.simulation.names import base_body_name, part_name
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.backends.simulation.variation import exact_variation
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.devices.drawing import Posture
from skillc_runtime.devices.gripper import Gripper
from skillc_runtime.devices.live import LiveBodies
from skillc_runtime.motion.pose import Array, quaternion_from_rotation


class Ghost(ModelDrawing):
    """Implements `Drawing`: arms, fingers and bases as they are measured, and all else where the facts had it first."""

    def __init__(
        self,
        scene: SceneSpec,
        joints: Mapping[str, Callable[[], Array]],
        grippers: Mapping[str, Gripper],
        bases: Mapping[str, MobileBase],
    ) -> None:
        """Build the model; `joints` return those (nv,) in rad of each arm."""
        variation = exact_variation(scene)
        model: Any = build_model(scene, variation)
        data = mujoco.MjData(model)
        super().__init__(scene, variation, model, data)
        self._ghost, self._joints, self._bases = data, joints, bases
        self._spans = {each.individual: _find_span(model, scene.names[each.individual]) for each in scene.arms}
        self._fingers = [
            (grippers[hand.individual], *find_fingers(model, scene.names[hand.individual]))
            for hand in _hands(scene.arms)
            if hand.individual in grippers
        ]
        self._mocaps = {
            each: int(model.body(base_body_name(scene.names[each])).mocapid[0])
            for each in bases
            if any(base.individual == each for base in scene.bases)
        }
        self.bodies = LiveBodies(self._read_positions, lambda: bytes(self._ghost.xquat.tobytes()))

    def posture(self) -> Posture:
        """Return a copy of the present posture."""
        self._place()
        return super().posture()

    def _place(self) -> None:
        data = self._ghost
        for individual, read in self._joints.items():
            data.qpos[self._spans[individual]] = read()
        for gripper, places, shares in self._fingers:
            data.qpos[places] = gripper.opening_m / shares.sum()
        for individual, number in self._mocaps.items():
            pose = self._bases[individual].pose
            data.mocap_pos[number], data.mocap_quat[number] = pose.position, quaternion_from_rotation(pose.rotation)

    def _read_positions(self) -> bytes:
        """Return the positions of all bodies; the quaternions are read after them."""
        self._place()
        mujoco.mj_kinematics(self.model, self._ghost)
        return bytes(self._ghost.xpos.tobytes())


def _hands(arms: tuple[ArmSpec, ...]) -> list[Any]:
    return [arm.gripper for arm in arms if arm.gripper is not None]


def _find_span(model: Any, name: str) -> slice:
    joints = [j for j in range(model.njnt) if model.joint(j).name.startswith(part_name(name, ""))]
    first = int(model.jnt_qposadr[joints[0]])
    return slice(first, first + len(joints))
