"""Strokes cover everything but the holes and what is too near to them, without touching one."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc_runtime.motion.lanes import lanes
from skillc_runtime.motion.pose import Pose, exp
from skillc_runtime.motion.strokes import Hole, Patch, over_patches, strokes

TOOL = np.array([0.1, 0.05])
SURFACE = np.array([0.4, 0.3])
spot = st.tuples(st.floats(-0.2, 0.2), st.floats(-0.15, 0.15)).map(np.array)
extent = st.tuples(st.floats(0.02, 0.1), st.floats(0.02, 0.1)).map(np.array)
holes = st.lists(st.builds(Hole, spot, extent), max_size=3)
directions = st.sampled_from(["longer", "x", "y"])


def footprints(stroke):
    """Yield middle and half size of the tool at many places of a stroke."""
    for one, other in itertools.pairwise(stroke):
        half = np.abs(one.rotation[:2, :2]) @ TOOL / 2
        for share in np.linspace(0.0, 1.0, 9):
            yield (one.position + share * (other.position - one.position))[:2], half


@settings(max_examples=40, deadline=None)
@given(holes, directions)
def test_no_hole_is_touched(gaps, direction):
    found = strokes(SURFACE, TOOL, 0.2, gaps, direction)
    looked = 0
    for middle, half in itertools.chain.from_iterable(map(footprints, found)):
        looked += 1
        for hole in gaps:
            assert (np.abs(middle - hole.middle) >= half + hole.size / 2 - 1e-9).any()
    assert looked or gaps


@settings(max_examples=40, deadline=None)
@given(holes, directions, spot)
def test_what_is_far_from_holes_is_passed(gaps, direction, point):
    near = TOOL.max() + 1e-6
    if any((np.abs(point - hole.middle) < hole.size / 2 + near).all() for hole in gaps):
        return
    found = strokes(SURFACE, TOOL, 0.2, gaps, direction)
    swept = itertools.chain.from_iterable(map(footprints, found))
    assert any((np.abs(point - middle) <= half + 0.03).all() for middle, half in swept)


@pytest.mark.parametrize("direction", ["longer", "x", "y"])
def test_without_holes_there_is_one_stroke_and_it_is_the_lanes(direction):
    (only,) = strokes(SURFACE, TOOL, 0.2, direction=direction)
    ends = lanes(SURFACE, TOOL, 0.2, direction=direction)
    assert np.array_equal([p.position for p in only], [p.position for p in ends])
    along = np.abs(ends[1].position - ends[0].position)[:2].argmax()
    assert along == (1 if direction == "y" else 0)


def test_a_hole_in_the_middle_parts_the_lanes_that_meet_it():
    found = strokes(SURFACE, TOOL, 0.2, [Hole(np.zeros(2), np.array([0.04, 0.04]))])
    assert len(found) > 2
    assert sum(len(stroke) for stroke in found) > len(lanes(SURFACE, TOOL, 0.2))


def test_several_patches_are_taken_each_time_the_nearest():
    frames = [
        Pose(np.array([x, 0.0, 0.0]), exp(np.array([0.0, 0.0, turn]))) for x, turn in ((2.0, 0.3), (0.0, 0.0), (1.0, 0))
    ]
    patches = [Patch(frame, SURFACE) for frame in frames]
    found = over_patches(patches, TOOL, 0.2, Pose(np.array([-1.0, 0.0, 0.0]), np.eye(3)))
    assert [round(float(np.mean([p.position[0] for p in stroke]))) for stroke in found] == [0, 1, 2]
    first = strokes(SURFACE, TOOL, 0.2)[0][0]
    assert np.allclose(found[2][0].position, frames[0].at(first.position))


def test_a_surface_that_is_all_hole_has_no_strokes():
    assert strokes(SURFACE, TOOL, 0.2, [Hole(np.zeros(2), np.ones(2))]) == []
