"""Poses of a tool."""

from skillc.space import Pose


def spot(_state: object, x: float, y: float, z: float) -> Pose:
    """A pose of the tool that points down."""
    return Pose.of((x, y, z), (0.0, 1.0, 0.0, 0.0))
