"""Poses, frames and computed relations of things."""

from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.bodies import read_bodies
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import attachment_changes, move_changes, placement_changes, pose, relative_pose

__all__ = [
    "FrameError",
    "Pose",
    "attachment_changes",
    "move_changes",
    "placement_changes",
    "pose",
    "read_bodies",
    "relative_pose",
]
