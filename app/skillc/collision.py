"""Obstacles, and joint paths around them."""

from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.collision_checker import CollisionChecker
from skillc_runtime.collision.collision_model import build_collision_model
from skillc_runtime.collision.path_planning import JointSpace, NoPath, plan_joint_path
from skillc_runtime.collision.scenery import read_scenery

__all__ = [
    "CollisionChecker",
    "JointSpace",
    "NoPath",
    "build_collision_model",
    "plan_joint_path",
    "read_arm_assembly",
    "read_scenery",
]
