"""What counts as worked on: cells that the face of a tool reaches, not those above which one side of it hangs."""

import numpy as np
import pytest

from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.layout import Layout
from skillc_runtime.motion.pose import Pose, exp

SURFACE = Pose.of((0.0, 0.0, 0.5))
TOOL = np.array([0.10, 0.05])
INTO = np.diag([1.0, -1.0, -1.0])


def share(height_m: float, tilt_rad: float) -> float:
    """Return the share of the cells under a tool that it works on, its middle so high above the surface."""
    covered = CoverageMap(SURFACE, Layout(np.array([0.4, 0.3])), 1.0)
    covered.add(np.array([0.0, 0.0, 0.5 + height_m]), exp(np.array([0.0, tilt_rad, 0.0])) @ INTO, TOOL, 0.01)
    flat = CoverageMap(SURFACE, Layout(np.array([0.4, 0.3])), 1.0)
    flat.add(np.array([0.0, 0.0, 0.5]), INTO, TOOL, 0.01)
    return float((covered.dose > 0).sum() / (flat.dose > 0).sum())


@pytest.mark.parametrize(
    ("height_m", "tilt_rad", "expected"),
    [
        (0.0, 0.0, 1.0),
        (-0.002, 0.0, 1.0),
        (0.001, 0.0, 0.0),
        (0.0, 0.1, 0.5),
        (-0.0025, 0.1, 0.75),
        (-0.002, 0.01, 1.0),
    ],
)
def test_a_cell_counts_where_the_face_reaches_it(height_m: float, tilt_rad: float, expected: float) -> None:
    assert share(height_m, tilt_rad) == pytest.approx(expected, abs=0.06)
