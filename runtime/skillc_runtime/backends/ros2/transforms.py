"""The frames that ROS 2 publishes (tf): the newest transform of each frame, and one frame in another."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np

from skillc_runtime.backends.ros2.pose_message import read_pose
from skillc_runtime.backends.ros2.receiver import Receiver
from skillc_runtime.motion.pose import Pose

KIND = "tf2_msgs/msg/TFMessage"
DEEPEST = 100
AT_ORIGIN = Pose(np.zeros(3), np.eye(3))


@dataclass(frozen=True, slots=True)
class Transform:
    """A frame in another one, as of `stamp_s`, in s of the clock of ROS; infinite for one that never changes."""

    parent: str
    pose: Pose
    stamp_s: float


class Transforms:
    """The tree of frames; call it with the lock of the receiver held."""

    def __init__(self, receiver: Receiver) -> None:
        """Subscribe to `/tf` and `/tf_static`; BackendUnavailable without the package of their messages."""
        self._newest: dict[str, Transform] = {}
        receiver.feed("/tf", KIND, False, self._take)
        receiver.feed("/tf_static", KIND, True, self._take_static, latched=True)

    def find(self, frame: str, within: str) -> Transform | None:
        """Return a frame in another one, dated by the oldest changing transform between them; None if they are apart.

        The chains from both up to the root have the frame in common where they meet.
        """
        up = self._chain(within)
        place, stamp_s = AT_ORIGIN, inf
        for _ in range(DEEPEST):
            if frame in up:
                meets, its_stamp_s = up[frame]
                return Transform(within, meets.inverse() @ place, min(stamp_s, its_stamp_s))
            if (above := self._newest.get(frame)) is None:
                return None
            frame, place, stamp_s = above.parent, above.pose @ place, min(stamp_s, above.stamp_s)
        return None

    def _chain(self, frame: str) -> dict[str, tuple[Pose, float]]:
        """Return the frames from one up to the root, with the pose of the one in each, and the oldest stamp."""
        place, stamp_s = AT_ORIGIN, inf
        found = {frame: (place, stamp_s)}
        while (above := self._newest.get(frame)) is not None and above.parent not in found:
            frame, place, stamp_s = above.parent, above.pose @ place, min(stamp_s, above.stamp_s)
            found[frame] = place, stamp_s
        return found

    def _take(self, message: Any) -> None:
        for each in message.transforms:
            stamp = each.header.stamp
            self._keep(each, stamp.sec + 1e-9 * stamp.nanosec)

    def _take_static(self, message: Any) -> None:
        for each in message.transforms:
            self._keep(each, inf)

    def _keep(self, message: Any, stamp_s: float) -> None:
        pose = read_pose(message.transform.translation, message.transform.rotation)
        self._newest[message.child_frame_id] = Transform(message.header.frame_id, pose, stamp_s)
