"""Where a tool works."""

from __future__ import annotations

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose


def working_face(size: Array) -> Pose:
    """Return the tool centre point of a tool of size (3,) in m, in the tool's frame.

    The tool's frame is at the centre of its block, z away from the working face; the tool centre point is at the centre
    of that face, z out of the tool, x along the tool's x.
    """
    return Pose(np.array([0.0, 0.0, -size[2] / 2]), np.diag([1.0, -1.0, -1.0]))
