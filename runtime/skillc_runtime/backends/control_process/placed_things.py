"""The things of a model, put where the world model has them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from contextlib import suppress
from typing import Any

import mujoco

from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.devices.drawing import DrawnIndividual
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation
from skillc_runtime.world.space.frame_tree import FrameError, frame_tree_of
from skillc_runtime.world.state.world_state import WorldState

CARRIED_ALONG = ("arm", "gripper", "base")
"""The kinds of individuals that are measured, and not placed by the world model."""


class PlacedThings:
    """Things, surfaces and fixtures of a model; `follow` puts them where a version of the world has them."""

    def __init__(
        self,
        scene: SceneSpec,
        model: Any,
        data: Any,
        individuals: Mapping[str, DrawnIndividual],
        state: WorldState,
    ) -> None:
        """Note where bodies of individuals are in the frames of these; the model is that of this version."""
        self._model, self._data = model, data
        self._bodies = {
            iri: int(model.body(each.body).id) for iri, each in individuals.items() if each.kind not in CARRIED_ALONG
        }
        self._free = {
            each.individual: int(model.joint(part_name(scene.names[each.individual], "free")).qposadr[0])
            for each in scene.graspable
        }
        self._tree, self._moved = frame_tree_of(state), frozenset[str]()
        mujoco.mj_kinematics(model, data)
        self._in_own_frame = dict(self._find_offsets())

    def follow(self, state: WorldState, moved: Collection[str]) -> bool:
        """Place all but those that were `moved`; return whether anything may have changed since the last call."""
        tree, others = frame_tree_of(state), frozenset(moved)
        if tree is self._tree and others == self._moved:
            return False
        self._tree, self._moved = tree, others
        for individual, in_own_frame in self._in_own_frame.items():
            if individual not in others:
                with suppress(FrameError):
                    self.place(individual, tree.pose(individual) @ in_own_frame)
        return True

    def place(self, individual: str, pose: Pose) -> None:
        """Put the body of a thing at a pose in the world."""
        position, quaternion = pose.position, quaternion_from_rotation(pose.rotation)
        if (first := self._free.get(individual)) is not None:
            self._data.qpos[first : first + 3], self._data.qpos[first + 3 : first + 7] = position, quaternion
        elif self._model.body_parentid[body := self._bodies[individual]] == 0:
            self._model.body_pos[body], self._model.body_quat[body] = position, quaternion

    def _find_offsets(self) -> Any:
        """Yield each thing that the world model places, and the pose of its body in its own frame."""
        for individual, body in self._bodies.items():
            there = Pose(self._data.xpos[body].copy(), self._data.xmat[body].reshape(3, 3).copy())
            with suppress(FrameError):
                yield individual, self._tree.pose(individual).inverse() @ there
