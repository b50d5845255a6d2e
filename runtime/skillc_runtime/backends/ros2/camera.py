"""A camera that ROS 2 drives: images, and the poses of objects by the frames of an estimator."""

from __future__ import annotations

from math import inf, isfinite
from typing import Any

import numpy as np

from skillc_runtime.backends.ros2.facts import CameraInterface
from skillc_runtime.backends.ros2.receiver import Receiver, TopicFeed
from skillc_runtime.backends.ros2.transforms import Transforms
from skillc_runtime.backends.simulation.cameras.camera_spec import CameraSpec
from skillc_runtime.devices.camera import PoseEstimate
from skillc_runtime.motion.pose import Array

IMAGE, INFO = "sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo"
DEPTHS = {"32FC1": (np.float32, 1.0), "16UC1": (np.uint16, 1e-3)}
"""How images have depths: the type of a pixel, and how many m its unit is."""


class Images:
    """The images of one topic; `newest` is the last one, None before the first."""

    def __init__(self, topic: str, reliable: bool, receiver: Receiver) -> None:
        self.newest: Any = None
        self.feed: TopicFeed = receiver.feed(topic, IMAGE, reliable, self._take)

    def _take(self, message: Any) -> None:
        self.newest = message


class Ros2Camera:
    """One camera; implements `PoseCamera`. An estimate is the frame of an object in that of the camera."""

    def __init__(
        self, spec: CameraSpec, interface: CameraInterface, transforms: Transforms | None, receiver: Receiver
    ) -> None:
        self._spec, self._interface, self._transforms, self._receiver = spec, interface, transforms, receiver
        reliable = interface.quality.reliable_states
        self.images = Images(interface.image, reliable, receiver) if interface.image else None
        self._depths = Images(interface.depth, reliable, receiver) if interface.depth else None
        self._lens: tuple[float, float, float, float] | None = None
        if interface.depth:
            receiver.feed(interface.info, INFO, reliable, self._take_lens)

    @property
    def feeds(self) -> list[TopicFeed]:
        """The topics of its images, which all have to come."""
        return [each.feed for each in (self.images, self._depths) if each is not None]

    @property
    def clock_s(self) -> float:
        """The present time in s of the clock of ROS."""
        return float(self._receiver.session.node.get_clock().now().nanoseconds) * 1e-9

    def locate(self, thing: str, since_s: float) -> PoseEstimate | None:
        """Return where the frame of an object, by IRI, was last seen at `since_s` or later; None if it was not."""
        frame = self._interface.frames.get(thing)
        if self._transforms is None or frame is None:
            return None
        with self._receiver.lock:  # wait ends: with the messages that have arrived
            found = self._transforms.find(frame, self._interface.frame)
        if found is None or not isfinite(found.stamp_s) or found.stamp_s < since_s:
            return None
        errors = self._spec.errors
        return PoseEstimate(found.pose, found.stamp_s, errors.position_noise_m, errors.angle_noise_rad)

    def depth_m(self, towards: Array) -> float | None:
        """Return the distance in m of what the newest depth image has at a point (3,) in the frame of the camera."""
        with self._receiver.lock:  # wait ends: with the messages that have arrived
            image, lens = None if self._depths is None else self._depths.newest, self._lens
        if image is None or lens is None or image.encoding not in DEPTHS or self._spec.view.obstacle(towards):
            return None
        fx, fy, cx, cy = lens
        x, y, z = towards
        column, row = round(fx * x / z + cx), round(fy * y / z + cy)
        if not (0 <= column < image.width and 0 <= row < image.height):
            return None
        kind, unit_m = DEPTHS[image.encoding]
        pixel = np.dtype(kind).newbyteorder(">" if image.is_bigendian else "<")
        place = row * image.step + column * pixel.itemsize
        along_axis = unit_m * float(np.frombuffer(image.data, pixel, 1, place)[0])
        if not isfinite(along_axis) or along_axis <= 0.0:
            return inf if along_axis == inf else None
        return along_axis * float(np.linalg.norm(towards)) / float(z)

    def _take_lens(self, message: Any) -> None:
        self._lens = message.k[0], message.k[4], message.k[2], message.k[5]
