"""Lanes cover the rectangle with the stated overlap, whatever the sizes."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillc_runtime.motion.lanes import plan_lanes

size = st.floats(0.05, 1.0)


@given(size, size, st.floats(0.07, 0.2), st.floats(0.04, 0.07), st.floats(0.1, 0.5))
def test_every_cell_is_passed_by_the_tool(width, height, length, breadth, overlap):
    ends = plan_lanes(np.array([width, height]), np.array([length, breadth]), overlap)
    longer = 0 if width >= height else 1
    extent = np.array([width, height])
    across = sorted({round(float(e.position[1 - longer]), 9) for e in ends})
    reach = max(abs(e.position[longer]) for e in ends)
    assert across[-1] + breadth / 2 >= extent[1 - longer] / 2
    assert reach + length / 2 >= extent[longer] / 2
    assert all(b - a <= breadth * (1 - overlap) + 1e-9 for a, b in itertools.pairwise(across))


@given(size, size)
def test_to_and_fro_with_the_tool_into_the_surface(width, height):
    ends = plan_lanes(np.array([width, height]), np.array([0.1, 0.05]), 0.2)
    for end in ends:
        assert np.allclose(end.rotation @ end.rotation.T, np.eye(3))
        assert np.linalg.det(end.rotation) == pytest.approx(1.0)
        assert np.allclose(end.rotation[:, 2], [0, 0, -1])
        assert end.position[2] == 0.0
    for before, after in zip(ends[1::2], ends[2::2], strict=False):
        assert np.linalg.norm(after.position - before.position) <= 0.04 + 1e-9


@pytest.mark.parametrize("surface, overlap", [((0.0, 0.1), 0.2), ((0.1, 0.1), 1.0), ((0.1, 0.1), -0.1)])
def test_refuses_nonsense(surface, overlap):
    with pytest.raises(ValueError, match="lanes"):
        plan_lanes(np.array(surface), np.array([0.1, 0.05]), overlap)
