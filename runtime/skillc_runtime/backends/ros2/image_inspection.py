"""Inspects surfaces and parts by the images that a camera of ROS 2 publishes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from time import monotonic
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.ros2.camera import IMAGE, INFO
from skillc_runtime.backends.ros2.device_facts import DeviceFacts, Timing
from skillc_runtime.backends.ros2.receiver import Receiver, TopicFeed
from skillc_runtime.backends.simulation.cameras.image_inspection import ImageInspection, Photo, count_rim_pixels
from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.arm_outline import find_arm_pixels
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.vision.lens import Lens
from skillc_runtime.vision.opencv import load_opencv
from skillc_runtime.world.space.frame_tree import frame_tree_of
from skillc_runtime.world.space.frames import arm_with_sensor, pose
from skillc_runtime.world.state.data_sheet import number_of, sheet_of
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import HAS_GRIPPER, INSPECTION_CAMERA, SKILLC
from skillc_runtime.world.state.world_state import WorldState

CHANNELS: Final[Mapping[str, tuple[int, tuple[int, int, int]]]] = {
    "rgb8": (3, (0, 1, 2)),
    "bgr8": (3, (2, 1, 0)),
    "rgba8": (4, (0, 1, 2)),
    "bgra8": (4, (2, 1, 0)),
    "mono8": (1, (0, 0, 0)),
}
"""The encodings that are read: bytes of a pixel, and which of them are red, green and blue."""

DISTORTIONS: Final = ("", "plumb_bob", "rational_polynomial")
"""The models of distortion that are those of OpenCV."""


@dataclass(frozen=True, slots=True)
class ImageTopics:
    """The topics of an inspection camera, by IRI, and how far it may be from where it is believed to be, m and rad."""

    camera: str
    name: str
    image: str
    info: str
    timing: Timing
    reliable: bool
    mount_m: float
    mount_rad: float


def read_image_topics(state: WorldState) -> ImageTopics | None:
    """Read the topics of the first inspection camera in order of IRI; None if it has no topic with images."""
    cameras = sorted(state.instances(INSPECTION_CAMERA))
    facts = DeviceFacts(state, cameras[0]) if cameras else None
    if facts is None or not (image := facts.topic("imageTopic")):
        return None
    sheet = sheet_of(state, facts.individual).individual
    return ImageTopics(
        camera=facts.individual,
        name=facts.name,
        image=image,
        info=facts.topic("cameraInfoTopic", f"{image.rpartition('/')[0]}/camera_info"),
        timing=facts.timing(1.0),
        reliable=facts.quality().reliable_states,
        mount_m=number_of(state, sheet, SKILLC + "mountError", default=0.0),
        mount_rad=number_of(state, sheet, SKILLC + "mountTilt", default=0.0),
    )


class Ros2ImageInspection(ImageInspection):
    """One camera that stands still, or is on the flange of an arm. Its lens is that of its `CameraInfo`.

    An image counts that is dated after it was asked for, or that came after that if images have no date. What hides
    a surface is known of arms alone, by their measured joints.
    """

    def __init__(
        self, topics: ImageTopics, world: WorldModel, arms: Mapping[str, RemoteArmDriver], receiver: Receiver
    ) -> None:
        """ModuleNotFoundError without OpenCV, FrameError if it is not stated where the camera is."""
        load_opencv()
        super().__init__(world)
        self._topics, self._arms, self._receiver = topics, arms, receiver
        state = world.snapshot()
        self._arm = arm_with_sensor(state, topics.camera)
        on_flange = self._arm is not None
        self._stated = frame_tree_of(state).own_pose(topics.camera) if on_flange else pose(state, topics.camera)
        self._newest: Any = None
        self._came_s, self._asked_s, self._asked_ros_s = 0.0, 0.0, 0.0
        self._lens: Any = None
        self.feeds: list[TopicFeed] = [
            receiver.feed(topics.image, IMAGE, topics.reliable, self._take_image),
            receiver.feed(topics.info, INFO, topics.reliable, self._take_lens),
        ]

    def request(self) -> None:
        """Let the next inspection be of an image that is taken from now on."""
        self._asked_s, self._asked_ros_s = monotonic(), self._clock_s()

    @property
    def waits_for(self) -> str:
        """The topic of the images until one has come that was taken since the last request."""
        with self._receiver.lock:  # wait ends: with the messages that have arrived
            return "" if self._is_new() else f"image of {self._topics.image}"

    def take_photo(self, looked_at: Pose, part: str = "") -> Photo:
        """Return the newest image, and where arms hide something in it; NoSuchDevice if it cannot be read."""
        with self._receiver.lock:  # wait ends: with the messages that have arrived
            message, info, is_new = self._newest, self._lens, self._is_new()
        if message is None or info is None or not is_new:
            raise NoSuchDevice(f"no new image of {self._topics.image} has come")
        image, lens = decode_image(message), read_info(info)
        high, wide = image.shape[:2]
        if (high, wide) != (lens.height, lens.width):
            of = f"{self._topics.info} is of {lens.width} x {lens.height}"
            raise NoSuchDevice(f"{self._topics.image} has images of {wide} x {high} pixels, and {of}")
        camera = self._find_camera(self._arm, self._stated, self._measure)
        return Photo(image, self._find_arms(looked_at, camera, lens), lens, camera)

    def _measure(self, arm: str) -> Array:
        return self._arms[arm].measured.q

    def _find_arms(self, looked_at: Pose, camera: Pose, lens: Lens) -> NDArray[np.bool_]:
        state, hidden = self._world.snapshot(), np.zeros((lens.height, lens.width), dtype=np.uint8)
        for arm in self._arms:
            openings = {
                each: sheet_of(state, each).number("maxOpening") for each in sorted(state.objects(arm, HAS_GRIPPER))
            }
            base = camera.inverse() @ pose(state, arm)
            hidden |= find_arm_pixels(read_arm_assembly(state, arm, openings), self._measure(arm), base, lens)
        away = float(np.linalg.norm(looked_at.position - camera.position))
        rim = count_rim_pixels(lens, self._topics.mount_m, self._topics.mount_rad, away)
        return np.asarray(load_opencv().dilate(hidden, np.ones((2 * rim + 1,) * 2, dtype=np.uint8)) > 0)

    def _is_new(self) -> bool:
        if self._newest is None:
            return False
        taken_s = _stamp_s(self._newest)
        return taken_s >= self._asked_ros_s if taken_s else self._came_s > self._asked_s

    def _clock_s(self) -> float:
        return float(self._receiver.session.node.get_clock().now().nanoseconds) * 1e-9

    def _take_image(self, message: Any) -> None:
        self._newest, self._came_s = message, monotonic()

    def _take_lens(self, message: Any) -> None:
        self._lens = message


def decode_image(message: Any) -> NDArray[np.uint8]:
    """Return the image (h, w, 3), red, green and blue, of a `sensor_msgs/msg/Image`; NoSuchDevice if it is not read."""
    if message.encoding not in CHANNELS:
        known = ", ".join(CHANNELS)
        raise NoSuchDevice(f"the images have the encoding {message.encoding!r}; these are read: {known}")
    size, order = CHANNELS[message.encoding]
    rows = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)
    pixels = rows[:, : message.width * size].reshape(message.height, message.width, size)
    return np.ascontiguousarray(pixels[:, :, order])


def read_info(message: Any) -> Lens:
    """Return the lens of a `sensor_msgs/msg/CameraInfo`; NoSuchDevice for a distortion that OpenCV does not know so."""
    if message.distortion_model not in DISTORTIONS:
        raise NoSuchDevice(f"the lens has the distortion {message.distortion_model!r}, which is not read")
    k = [float(each) for each in message.k]
    return Lens(message.width, message.height, k[0], k[4], k[2], k[5], tuple(float(each) for each in message.d))


def _stamp_s(message: Any) -> float:
    return float(message.header.stamp.sec) + 1e-9 * float(message.header.stamp.nanosec)
