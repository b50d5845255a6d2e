"""Strokes pass all that the tool can be over without touching a hole, and touch none."""

from __future__ import annotations

import itertools
import os

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace

from skillc_runtime.motion.lanes import OVERHANG_M, plan_lanes
from skillc_runtime.motion.layout import Hole, Layout, Patch
from skillc_runtime.motion.pose import Pose, exp
from skillc_runtime.motion.strokes import plan_layout_strokes, plan_strokes

EXAMPLES = int(os.environ.get("SKILLC_MOTIONS", "10"))
"""Of each property; more, once, by the environment."""

TOOL = np.array([0.1, 0.05])
SURFACE = np.array([0.4, 0.3])
spot = st.tuples(st.floats(-0.2, 0.2), st.floats(-0.15, 0.15)).map(np.array)
extent = st.tuples(st.floats(0.02, 0.1), st.floats(0.02, 0.1)).map(np.array)
holes = st.lists(st.builds(Hole, spot, extent, st.sampled_from([0.0, 0.02])), max_size=3)
directions = st.sampled_from(["longer", "x", "y"])


def footprints(stroke):
    """Yield middle and half size of the tool at many places of a stroke."""
    for one, other in itertools.pairwise(stroke):
        half = np.abs(one.rotation[:2, :2]) @ TOOL / 2
        for share in np.linspace(0.0, 1.0, 9):
            yield (one.position + share * (other.position - one.position))[:2], half


def clear(places, half, gaps):
    """Tell of places (n, 2) of a tool of a half size (2,) whether it touches no hole nor half of its margin there."""
    free = np.ones(len(places), dtype=bool)
    for hole in gaps:
        free &= (np.abs(places - hole.centre) >= half + hole.size / 2 + hole.margin / 2 - 2e-6).any(axis=1)
    return free


@settings(max_examples=EXAMPLES)
@given(holes, directions)
def test_no_hole_is_touched(gaps, direction):
    found = plan_strokes(SURFACE, TOOL, 0.2, gaps, direction)
    passed = list(itertools.chain.from_iterable(map(footprints, found)))
    for middle, half in passed:
        assert clear(middle[None], half, gaps).all()
    assert passed or gaps


@settings(max_examples=EXAMPLES)
@given(holes, directions, st.floats(0.0, 0.5))
def test_whatever_the_tool_can_be_over_is_passed(gaps, direction, overlap):
    cells = np.stack(np.meshgrid(np.linspace(-0.2, 0.2, 41), np.linspace(-0.15, 0.15, 31)), axis=-1).reshape(-1, 2)
    found, passed = plan_strokes(SURFACE, TOOL, overlap, gaps, direction), np.zeros(len(cells), dtype=bool)
    half = (TOOL[::-1] if direction == "y" else TOOL) / 2
    for middle, _ in itertools.chain.from_iterable(map(footprints, found)):
        passed |= (np.abs(cells - middle) <= half + 1e-6).all(axis=1)
    farthest = SURFACE / 2 - half + np.array(OVERHANG_M[::-1] if direction == "y" else OVERHANG_M)
    places = np.stack(np.meshgrid(*(np.linspace(-far, far, 19) for far in farthest)), axis=-1).reshape(-1, 2)
    reached = np.zeros(len(cells), dtype=bool)
    for place in places[clear(places, half, gaps)]:
        reached |= (np.abs(cells - place) <= half).all(axis=1)
    assert not (reached & ~passed).any()
    assert passed.any() == reached.any()


@pytest.mark.parametrize("direction", ["longer", "x", "y"])
def test_without_holes_there_is_one_stroke_and_it_is_the_lanes(direction):
    (only,) = plan_strokes(SURFACE, TOOL, 0.2, direction=direction)
    ends = plan_lanes(SURFACE, TOOL, 0.2, direction=direction)
    assert np.array_equal([p.position for p in only], [p.position for p in ends])
    along = np.abs(ends[1].position - ends[0].position)[:2].argmax()
    assert along == (1 if direction == "y" else 0)


def test_a_hole_is_passed_on_either_side_without_lifting_the_tool():
    (only,) = plan_strokes(SURFACE, TOOL, 0.2, [Hole(np.zeros(2), np.array([0.04, 0.04]))])
    assert len(only) > len(plan_lanes(SURFACE, TOOL, 0.2))
    beside = {round(float(pose.position[1]), 6) for pose in only if abs(pose.position[0]) < 0.0701}
    assert {0.045, -0.045} <= beside


def test_behind_a_hole_from_edge_to_edge_the_tool_is_lifted():
    found = plan_strokes(SURFACE, TOOL, 0.2, [Hole(np.zeros(2), np.array([0.04, 0.3]))])
    assert len(found) == 2
    assert {bool(stroke[0].position[0] > 0) for stroke in found} == {True, False}


def test_patches_are_taken_each_time_the_nearest_and_their_holes_are_left_out():
    frames = [
        Pose(np.array([x, 0.0, 0.0]), exp(np.array([0.0, 0.0, turn]))) for x, turn in ((2.0, 0.3), (0.0, 0.0), (1.0, 0))
    ]
    layout = Layout(np.array([5.0, 1.0]), tuple(Patch(frame, SURFACE) for frame in frames))
    start = Pose(np.array([-1.0, 0.0, 0.0]), np.eye(3))
    found = plan_layout_strokes(layout, TOOL, 0.2, start)
    assert [round(float(np.mean([p.position[0] for p in stroke]))) for stroke in found] == [0, 1, 2]
    first = plan_strokes(SURFACE, TOOL, 0.2)[0][0]
    assert np.allclose(found[2][0].position, frames[0].apply(first.position))
    holed = plan_layout_strokes(
        replace(layout, holes=(Hole(np.array([1.0, 0.0]), np.array([0.04, 0.04])),)), TOOL, 0.2, start
    )
    assert [len(stroke) for stroke in holed][::2] == [len(stroke) for stroke in found][::2]
    assert len(holed[1]) > len(found[1])


def test_what_counts_is_what_lies_in_a_patch_and_out_of_the_margins():
    hole = Hole(np.array([0.1, 0.0]), np.array([0.04, 0.04]), margin=0.01)
    patch = Patch(Pose(np.array([0.0, 0.0, 0.0]), exp(np.array([0.0, 0.0, np.pi / 2]))), np.array([0.1, 0.3]))
    x, y = np.array([-0.16, -0.14, 0.06, 0.08, 0.11, 0.14]), np.array([-0.06, 0.0, 0.04])
    counts = Layout(SURFACE, (patch,), (hole,)).work_mask(x, y)
    assert counts.tolist() == [
        [False] * 6,
        [False, True, True, False, False, True],
        [False, True, True, True, True, True],
    ]
    assert Layout(SURFACE).work_mask(x, y).all()


def test_a_surface_that_is_all_hole_has_no_strokes():
    assert plan_strokes(SURFACE, TOOL, 0.2, [Hole(np.zeros(2), np.ones(2))]) == []
