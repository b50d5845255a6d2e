"""The devices of a cell besides its arms: made from the facts, waited for, and watched."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from itertools import chain
from typing import Any

import mujoco

from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.real_time.device_cell import CellDevices
from skillc_runtime.backends.ros2.base import Ros2Base
from skillc_runtime.backends.ros2.camera import Ros2Camera
from skillc_runtime.backends.ros2.device_facts import DeviceFacts, Timing
from skillc_runtime.backends.ros2.facts import read_base, read_camera, read_gripper, read_inspected
from skillc_runtime.backends.ros2.gripper import Ros2Gripper
from skillc_runtime.backends.ros2.image_inspection import Ros2ImageInspection, read_image_topics
from skillc_runtime.backends.ros2.inspection import Ros2Inspection
from skillc_runtime.backends.ros2.receiver import Receiver, TopicFeed
from skillc_runtime.backends.ros2.transforms import Transforms
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.devices.backend import BackendUnavailable, DeviceStop, find_first_stop
from skillc_runtime.devices.sensors import Button, Camera
from skillc_runtime.world.state.data_sheet import number_of, sheet_of
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import ARRIVAL_TOLERANCE

ARRIVAL_TOLERANCE_M = 0.05


def make_devices(world: WorldModel, scene: SceneSpec, arms: Mapping[str, RemoteArmDriver]) -> CellDevices:
    """Return all devices but the arms; BackendUnavailable if one of them does not answer."""
    with ExitStack() as opened:
        receiver = Receiver("skillc_devices")
        opened.callback(receiver.close)
        devices = _Devices(world, scene, arms, receiver)
        if not receiver.is_needed:
            return CellDevices()
        devices.begin()
        opened.pop_all()
    return CellDevices(
        grippers=devices.grippers,
        bases=devices.bases,
        cameras=devices.cameras,
        buttons=devices.buttons,
        inspection=devices.inspection,
        find_fault=devices.find_fault,
        recover=devices.recover,
        close=receiver.close,
    )


@dataclass(frozen=True, slots=True)
class _Topic:
    """What a device, by IRI, publishes; `who` is its short name."""

    device: str
    who: str
    feed: TopicFeed
    timing: Timing


class _Devices:
    """Those of one cell, with what each of them has to publish."""

    def __init__(
        self, world: WorldModel, scene: SceneSpec, arms: Mapping[str, RemoteArmDriver], receiver: Receiver
    ) -> None:
        self._state, self._receiver = world.snapshot(), receiver
        self._watched: list[_Topic] = []
        """Topics that may never be silent."""
        self._awaited: list[_Topic] = []
        """Topics that may be silent after their first message."""
        self.grippers = self._make_grippers(scene, arms)
        self.bases = self._make_bases(scene)
        self.cameras = self._make_cameras(scene)
        self.buttons = self._make_buttons(scene)
        self.inspection = self._make_inspection(world, arms)

    def begin(self) -> None:
        """Wait for the first message of each topic; BackendUnavailable."""
        self._receiver.begin()
        for each in (*self._watched, *self._awaited):
            self._receiver.await_first(each.feed, each.timing, each.who)

    def find_fault(self) -> DeviceStop | None:
        """Return why a device cannot go on; None if all can."""
        faults = ((individual, hand.fault) for individual, hand in self.grippers.items())
        silences = ((each.device, each.feed.find_silence(each.timing)) for each in self._watched)
        return find_first_stop(chain(faults, silences))

    def recover(self) -> None:
        """Acknowledge what the devices have reported."""
        for hand in self.grippers.values():
            hand.recover()

    def _make_grippers(self, scene: SceneSpec, arms: Mapping[str, RemoteArmDriver]) -> dict[str, Ros2Gripper]:
        found: dict[str, Ros2Gripper] = {}
        for arm in scene.arms:
            if (hand := arm.gripper) is not None:
                facts = read_gripper(self._state, hand.individual, joints_of(str(hand.model)))
                found[hand.individual] = made = Ros2Gripper(hand, facts, arms[arm.individual], self._receiver)
                self._watched.append(_Topic(hand.individual, facts.name, made.feed, facts.timing))
        return found

    def _make_bases(self, scene: SceneSpec) -> dict[str, Ros2Base]:
        found: dict[str, Ros2Base] = {}
        for each in scene.bases:
            facts, sheet = read_base(self._state, each.individual), sheet_of(self._state, each.individual).individual
            near_m = number_of(self._state, sheet, ARRIVAL_TOLERANCE, ARRIVAL_TOLERANCE_M)
            found[each.individual] = made = Ros2Base(facts, each.pose, near_m, self._receiver)
            self._watched.append(_Topic(each.individual, facts.name, made.feed, facts.timing))
        return found

    def _make_cameras(self, scene: SceneSpec) -> dict[str, Ros2Camera]:
        found: dict[str, Ros2Camera] = {}
        transforms: Transforms | None = None
        for spec in scene.cameras:
            if (facts := read_camera(self._state, spec.individual)) is None:
                continue
            if facts.frame and transforms is None:
                transforms = Transforms(self._receiver)
            found[spec.individual] = made = Ros2Camera(spec, facts, transforms, self._receiver)
            self._watched += [_Topic(spec.individual, facts.name, feed, facts.timing) for feed in made.feeds]
        return found

    def _make_inspection(self, world: WorldModel, arms: Mapping[str, RemoteArmDriver]) -> Camera | None:
        """Return the camera that inspects by its images, or else by the topics of surfaces; BackendUnavailable."""
        topics, shares = read_image_topics(self._state), read_inspected(self._state)
        if topics is None:
            return Ros2Inspection(shares, self._receiver) if shares else None
        try:
            made = Ros2ImageInspection(topics, world, arms, self._receiver)
        except ModuleNotFoundError as error:
            raise BackendUnavailable(f"{topics.name} takes images, which nothing reads here: {error}") from error
        self._awaited += [_Topic(topics.camera, topics.name, feed, topics.timing) for feed in made.feeds]
        return made

    def _make_buttons(self, scene: SceneSpec) -> dict[str, Ros2Button]:
        found: dict[str, Ros2Button] = {}
        for each in scene.fixtures:
            facts = DeviceFacts(self._state, each.individual)
            if facts.topic("switchedTopic"):
                found[each.individual] = made = Ros2Button(facts, self._receiver)
                self._awaited.append(_Topic(each.individual, facts.name, made.feed, facts.timing(1.0)))
        return found


def joints_of(file: str) -> tuple[str, ...]:
    """Return the names of the joints of a model, in its order."""
    model = mujoco.MjModel.from_xml_path(file)
    return tuple(model.joint(number).name for number in range(model.njnt))


class Ros2Button(Button):
    """One button; its first message is waited for, and later ones may come only when it changes."""

    def __init__(self, facts: DeviceFacts, receiver: Receiver) -> None:
        reliable, topic = facts.quality().reliable_states, facts.topic("switchedTopic")
        self.feed = receiver.feed(topic, "std_msgs/msg/Bool", reliable, self._take)
        self._switched = False

    @property
    def switched(self) -> bool:
        """Whether it is pressed so far that it has switched."""
        return self._switched

    def _take(self, message: Any) -> None:
        self._switched = bool(message.data)
