"""Poses in messages of ROS 2 (geometry_msgs), whose quaternions have w last."""

from __future__ import annotations

from typing import Any

from skillc_runtime.motion.pose import Pose, quaternion_from_rotation


def write_pose(pose: Pose, message: Any) -> None:
    """Write a pose to a message `Pose`."""
    at, turn = message.position, message.orientation
    at.x, at.y, at.z = pose.position.tolist()
    turn.w, turn.x, turn.y, turn.z = quaternion_from_rotation(pose.rotation).tolist()


def read_pose(position: Any, orientation: Any) -> Pose:
    """Return the pose of a message `Point` or `Vector3` and a message `Quaternion`."""
    at, turn = position, orientation
    return Pose.of((at.x, at.y, at.z), (turn.w, turn.x, turn.y, turn.z))
