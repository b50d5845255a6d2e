"""The model of a cell of real devices, put where they are measured and where things are known to be: for displays."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Protocol

import mujoco

from skillc_runtime.backends.control_process.fingers import find_fingers
from skillc_runtime.backends.kinematic.riders import Riders
from skillc_runtime.backends.simulation.model.drawing import ModelDrawing
from skillc_runtime.backends.simulation.model.model_builder import build_model
from skillc_runtime.backends.simulation.names import base_body_name, part_name
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.backends.simulation.variation.variation import exact_variation
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.devices.drawing import DrawnIndividual, Posture
from skillc_runtime.devices.gripper import Gripper
from skillc_runtime.devices.live import LiveBodies
from skillc_runtime.motion.pose import Array, Pose, quaternion_from_rotation
from skillc_runtime.world.space.frame_tree import FrameError, frame_tree_of
from skillc_runtime.world.state.world_state import WorldState

CARRIED_ALONG = ("arm", "gripper", "base")
"""The kinds of individuals that are measured, and not placed by the world model."""


class ShownArm(Protocol):
    """What is drawn of an arm."""

    @property
    def joints(self) -> Array:
        """The measured joints (nv,) in rad."""
        ...

    @property
    def held(self) -> tuple[str, Pose] | None:
        """What its hand holds, and at which pose in the frame of the empty hand's tool centre point."""
        ...


@dataclass(frozen=True, slots=True)
class _Hand:
    """The hand of an arm in the model: its tool centre point by number, and what stands on what it holds."""

    arm: ShownArm
    tool_centre: int
    riders: Riders


class Ghost(ModelDrawing):
    """Implements `Drawing`: arms, fingers and bases as they are measured, what hands hold in them.

    All else is where the world model has it; what that does not place stays where it was.
    """

    def __init__(
        self,
        scene: SceneSpec,
        arms: Mapping[str, ShownArm],
        grippers: Mapping[str, Gripper],
        bases: Mapping[str, MobileBase],
        snapshot: Callable[[], WorldState],
    ) -> None:
        """Build the model; `snapshot` returns the world as it is known now."""
        variation = exact_variation(scene)
        model: Any = build_model(scene, variation)
        data = mujoco.MjData(model)
        super().__init__(scene, variation, model, data)
        self._ghost, self._arms, self._bases, self._snapshot = data, arms, bases, snapshot
        self._spans = {each.individual: _find_span(model, scene.names[each.individual]) for each in scene.arms}
        self._fingers = [
            (grippers[hand.individual], *find_fingers(model, scene.names[hand.individual]))
            for hand in _hands(scene.arms)
            if hand.individual in grippers
        ]
        self._hands = [
            _Hand(arms[each.individual], _find_tool_centre(model, scene, each), Riders(scene, model, data))
            for each in scene.arms
            if each.gripper is not None
        ]
        self._mocaps = {
            each: int(model.body(base_body_name(scene.names[each])).mocapid[0])
            for each in bases
            if any(base.individual == each for base in scene.bases)
        }
        self._things = PlacedThings(scene, model, data, self.individuals, snapshot())
        self.bodies = LiveBodies(self._read_positions, lambda: bytes(self._ghost.xquat.tobytes()))

    def posture(self) -> Posture:
        """Return a copy of the present posture."""
        self._place()
        return super().posture()

    def _place(self) -> None:
        data = self._ghost
        for individual, arm in self._arms.items():
            data.qpos[self._spans[individual]] = arm.joints
        for gripper, places, shares in self._fingers:
            data.qpos[places] = gripper.opening_m / shares.sum()
        for individual, number in self._mocaps.items():
            pose = self._bases[individual].pose
            data.mocap_pos[number], data.mocap_quat[number] = pose.position, quaternion_from_rotation(pose.rotation)
        mujoco.mj_kinematics(self.model, data)
        self._place_things()

    def _place_things(self) -> None:
        """Place what hands hold in them, with what stands on it, and all else where the world model has it."""
        data, moved = self._ghost, set[str]()
        for hand in self._hands:
            held = hand.arm.held
            if held is not None:
                thing, in_tool_centre = held
                tool = Pose(data.site_xpos[hand.tool_centre], data.site_xmat[hand.tool_centre].reshape(3, 3))
                self._things.place(thing, tool @ in_tool_centre)
                moved.add(thing)
            moved.update(hand.riders.follow(None if held is None else held[0]))
        if self._things.follow(self._snapshot(), moved) or moved:
            mujoco.mj_kinematics(self.model, data)

    def _read_positions(self) -> bytes:
        """Return the positions of all bodies; the quaternions are read after them."""
        self._place()
        return bytes(self._ghost.xpos.tobytes())


def _hands(arms: tuple[ArmSpec, ...]) -> list[Any]:
    return [arm.gripper for arm in arms if arm.gripper is not None]


def _find_tool_centre(model: Any, scene: SceneSpec, arm: ArmSpec) -> int:
    assert arm.gripper is not None
    return int(model.site(part_name(scene.names[arm.gripper.individual], "tcp")).id)


def _find_span(model: Any, name: str) -> slice:
    joints = [j for j in range(model.njnt) if model.joint(j).name.startswith(part_name(name, ""))]
    first = int(model.jnt_qposadr[joints[0]])
    return slice(first, first + len(joints))


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
