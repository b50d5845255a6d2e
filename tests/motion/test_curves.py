"""Arcs and smooth profiles: derivatives, bounds, and how they join with lines."""

from __future__ import annotations

import itertools
import os
from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc_runtime.motion.paths.arc import arc_around, arc_through
from skillc_runtime.motion.paths.path import join_segments, path_through
from skillc_runtime.motion.paths.profile import trapezoidal_profile
from skillc_runtime.motion.paths.segments import MotionLimits, segment_between
from skillc_runtime.motion.paths.smooth import SmoothProfile, window_for
from skillc_runtime.motion.pose import Pose, exp, log

EXAMPLES = int(os.environ.get("SKILLC_MOTIONS", "15"))
"""Of each property; more, once, by the environment."""

LIMITS = MotionLimits(speed=0.2, acceleration=0.5)
JERKY = MotionLimits(speed=0.2, acceleration=0.5, jerk=5.0, turn_jerk=20.0)
START = Pose(np.zeros(3), np.eye(3))
UP = np.array([0.0, 0.0, 1.0])
coordinate = st.floats(-0.3, 0.3)
points = st.tuples(*[coordinate] * 3).map(np.array)
turns = st.tuples(*[st.floats(-1.0, 1.0)] * 3).map(lambda v: exp(np.array(v)))


def bent(via, end) -> bool:
    return np.linalg.norm(np.cross(via, end)) > 1e-2 * np.linalg.norm(via) * np.linalg.norm(end) > 1e-6


@settings(max_examples=EXAMPLES)
@given(points, points, turns, st.sampled_from([LIMITS, JERKY]))
def test_an_arc_goes_through_its_three_points_within_limits(via, end, rotation, limits):
    if not bent(via, end):
        return
    piece = arc_through(START, via, Pose(end, rotation), limits)
    motion = join_segments([START, Pose(end, rotation)], [piece], limits)
    samples = [motion.at(t) for t in np.linspace(0, motion.duration, 101)]
    places = np.array([s.pose.position for s in samples])
    assert np.abs(places[-1] - end).max() < 1e-9
    assert np.abs(samples[-1].pose.rotation - rotation).max() < 2e-9, "turns of up to 1e-9 rad are none"
    assert np.linalg.norm(places - via, axis=1).min() <= 0.21 * motion.duration / 100
    centre = -piece.spoke
    assert np.abs(np.linalg.norm(places - centre, axis=1) - piece.radius).max() < 1e-9 * (1 + piece.radius)
    for sample in samples:
        assert np.linalg.norm(sample.twist[:3]) <= limits.speed * (1 + 1e-9)
        assert np.linalg.norm(sample.acceleration[:3]) <= limits.acceleration * (1 + 1e-9)


@settings(max_examples=EXAMPLES)
@given(points, points, turns, st.floats(0.0, 0.03), st.floats(0.02, 0.98), st.sampled_from([LIMITS, JERKY]))
def test_lines_and_arcs_join_smoothly_and_cut_corners_by_the_blend_at_most(via, end, rotation, blend, share, limits):
    if not bent(via, end):
        return
    corners = [Pose(np.array([-0.2, 0.0, 0.1]), np.eye(3)), START, Pose(end, rotation), Pose(end + 0.1, rotation)]
    pieces = [
        segment_between(corners[0], START, limits),
        arc_through(START, via, corners[2], limits),
        segment_between(corners[2], corners[3], limits),
    ]
    motion, h = join_segments(corners, pieces, limits, blend), 1e-6
    before, now, after = (motion.at(share * motion.duration + d) for d in (-h, 0.0, h))
    angular = log(after.pose.rotation @ before.pose.rotation.T) / (2 * h)
    assert np.allclose(now.twist, [*(after.pose.position - before.pose.position) / (2 * h), *angular], atol=2e-4)
    samples = [motion.at(t) for t in np.linspace(0, motion.duration, 120)]
    step = 0.29 * motion.duration / 119
    for corner in corners:
        assert min(np.linalg.norm(s.pose.position - corner.position) for s in samples) <= blend + step
    for one, other in itertools.pairwise(samples):
        assert np.linalg.norm(other.twist - one.twist) <= 8 * motion.duration / 119
    assert np.abs(samples[-1].pose.position - corners[3].position).max() < 1e-9


def test_a_whole_circle_comes_back_and_its_frame_may_be_moved():
    piece = arc_around(START, np.array([0.1, 0.0, 0.0]), UP, 2 * pi, START, LIMITS)
    motion = join_segments([START, START], [piece], LIMITS)
    assert np.abs(motion.at(motion.duration).pose.position).max() < 1e-9
    assert np.abs(motion.at(motion.duration / 2).pose.position - [0.2, 0.0, 0.0]).max() < 1e-9
    frame = Pose(np.array([1.0, 2.0, 3.0]), exp(np.array([0.3, -0.2, 0.5])))
    there = motion.transform(frame).at(0.7)
    assert np.allclose(there.pose.position, frame.apply(motion.at(0.7).pose.position))
    assert np.allclose(there.twist[:3], frame.rotation @ motion.at(0.7).twist[:3])


@pytest.mark.parametrize("via", [(0.1, 0.0, 0.0), (0.0, 0.0, 0.0), (0.2, 0.0, 0.0), (-0.1, 0.0, 0.0)])
def test_points_on_a_line_are_refused(via):
    with pytest.raises(ValueError, match="three points on a line make no circle"):
        arc_through(START, np.array(via), Pose(np.array([0.2, 0.0, 0.0]), np.eye(3)), LIMITS)


@settings(max_examples=4 * EXAMPLES)
@given(st.floats(1e-3, 3.0), st.floats(0.05, 0.5), st.floats(0.1, 2.0), st.floats(1.0, 50.0), st.floats(0.01, 0.99))
def test_a_smooth_profile_is_its_own_derivative_and_keeps_its_limits(length, speed, acceleration, jerk, share):
    profile = SmoothProfile(trapezoidal_profile(length, speed, acceleration), window_for(acceleration, jerk))
    time, h = share * profile.duration, 1e-6
    (s0, v0, a0), (_, v, a), (s1, v1, a1) = (profile.at(time + d) for d in (-h, 0.0, h))
    assert (s1 - s0) / (2 * h) == pytest.approx(v, abs=1e-5)
    assert (v1 - v0) / (2 * h) == pytest.approx(a, abs=1e-4 * (1 + jerk))
    assert abs(a1 - a0) / (2 * h) <= jerk * (1 + 1e-3) + 1e-4
    assert -1e-9 <= v <= speed * (1 + 1e-9)
    assert abs(a) <= acceleration * (1 + 1e-9)
    assert profile.at(profile.duration) == (length, 0.0, 0.0)
    assert profile.at(profile.duration - 1e-9)[0] == pytest.approx(length, abs=1e-6)
    assert profile.at(0.0)[:2] == (0.0, 0.0)


def test_a_path_with_a_jerk_limit_never_jumps_in_acceleration():
    corners = [Pose(np.array(p), np.eye(3)) for p in ((0.0, 0, 0), (0.2, 0, 0), (0.2, 0.2, 0), (0.3, 0.2, 0.0))]
    smooth, plain = path_through(corners, JERKY, 0.01), path_through(corners, LIMITS, 0.01)
    h = smooth.duration / 2000
    jumps = [
        max(np.abs(np.diff([m.at(t).acceleration[:3] for t in np.arange(0, m.duration, h)], axis=0)).max() / h, 0.0)
        for m in (smooth, plain)
    ]
    assert jumps[0] <= 2 * JERKY.jerk
    assert jumps[1] > 10 * JERKY.jerk
    with pytest.raises(ValueError, match="above 0"):
        MotionLimits(0.1, 0.1, jerk=0.0).window  # noqa: B018
