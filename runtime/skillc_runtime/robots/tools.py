"""Where a tool works: the convention that grippers, primitives and simulation share."""

from __future__ import annotations

import numpy as np

from skillc_runtime.motion.pose import Array, Pose


def working_face(size: Array) -> Pose:
    """Return the tool centre point of a tool of size (3,) m, in the tool's frame.

    The tool's frame lies in the middle of its block, z away from the working face; the tool centre point lies in the
    middle of that face, z out of the tool, x along the tool's x.
    """
    return Pose(np.array([0.0, 0.0, -size[2] / 2]), np.diag([1.0, -1.0, -1.0]))
