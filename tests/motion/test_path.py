"""Paths: derivatives by finite differences, blending bounds, purity in time."""

import itertools

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose, exp, log

LIMITS = MotionLimits(speed=0.2, acceleration=0.5)
coordinate = st.floats(-0.4, 0.4)
poses = st.lists(
    st.builds(
        lambda p, r: Pose(np.array(p), exp(np.array(r))),
        st.tuples(*[coordinate] * 3),
        st.tuples(*[st.floats(-1.5, 1.5)] * 3),
    ),
    min_size=2,
    max_size=5,
)


def close(a: Pose, b: Pose, tolerance: float = 1e-9) -> bool:
    return np.abs(a.position - b.position).max() < tolerance and np.abs(a.rotation - b.rotation).max() < tolerance


@settings(max_examples=40)
@given(poses, st.floats(0.0, 0.05), st.floats(0.01, 0.99))
def test_twist_is_the_derivative_of_the_pose(corners, blend, share):
    motion, h = path_through(corners, LIMITS, blend), 1e-6
    time = share * motion.duration
    before, now, after = (motion.at(time + d) for d in (-h, 0.0, h))
    linear = (after.pose.position - before.pose.position) / (2 * h)
    angular = log(after.pose.rotation @ before.pose.rotation.T) / (2 * h)
    assert np.allclose(now.twist, [*linear, *angular], atol=2e-4)


@settings(max_examples=40)
@given(poses, st.floats(0.0, 0.05))
def test_acceleration_is_the_derivative_of_the_twist_almost_everywhere(corners, blend):
    motion, h = path_through(corners, LIMITS, blend), 1e-5
    assume(motion.duration > 0.05)  # a turn of 1e-8 rad is over before differences of this size can measure it
    times = np.linspace(0, motion.duration, 101)[1:-1]
    wrong = 0
    for time in times:
        slope = (motion.at(time + h).twist - motion.at(time - h).twist) / (2 * h)
        wrong += not np.allclose(slope, motion.at(time).acceleration, atol=1e-3)
    assert len(times) == 99
    assert wrong <= 4 * (len(corners) + 1)  # only where a profile changes between accelerating and cruising


@settings(max_examples=40)
@given(poses, st.floats(0.0, 0.05))
def test_starts_at_the_first_and_ends_at_the_last_pose(corners, blend):
    motion = path_through(corners, LIMITS, blend)
    assert close(motion.at(-1.0).pose, corners[0])
    assert close(motion.at(motion.duration + 1.0).pose, corners[-1], 1e-7)
    assert not motion.at(motion.duration + 1.0).twist.any()


@settings(max_examples=40)
@given(poses, st.floats(0.001, 0.05))
def test_corners_are_cut_by_the_blend_at_most_and_the_speed_stays_within_limits(corners, blend):
    motion = path_through(corners, LIMITS, blend)
    samples = [motion.at(t) for t in np.linspace(0, motion.duration, 200)]
    for corner in corners:
        assert (
            min(np.linalg.norm(s.pose.position - corner.position) for s in samples)
            <= blend + 0.21 * motion.duration / 199
        )
    for before, after in itertools.pairwise(samples):
        assert np.linalg.norm(after.twist[:3]) <= LIMITS.speed * (1 + 1e-9)
        assert np.linalg.norm(after.acceleration[:3]) <= 2 * LIMITS.acceleration + 1e-9
        assert np.linalg.norm(after.pose.position - before.pose.position) <= 0.21 * motion.duration / 199 + 1e-9


def test_a_right_angle_never_slows_below_71_percent_and_saves_time():
    corners = [Pose.of(p) for p in ((0, 0, 0), (0.3, 0, 0), (0.3, 0.3, 0))]
    limits = MotionLimits(speed=0.1, acceleration=0.4)
    stopping, blended = path_through(corners, limits), path_through(corners, limits, 0.05)
    speeds = [np.linalg.norm(blended.at(t).twist[:3]) for t in np.linspace(0.5, blended.duration - 0.5, 1000)]
    assert min(speeds) == pytest.approx(0.0707, abs=1e-3)
    assert stopping.duration - blended.duration == pytest.approx(0.1 / 0.4)
    nearest = min(
        np.linalg.norm(blended.at(t).pose.position - corners[1].position)
        for t in np.linspace(0, blended.duration, 4000)
    )
    assert nearest == pytest.approx(0.1**2 / (8 * 0.4) * np.sqrt(2), rel=0.02)


def test_time_may_run_in_any_order():
    motion = path_through(
        [Pose.of((0, 0, 0)), Pose.of((0.2, 0, 0)), Pose.of((0.2, 0.1, 0), (0, 1, 0, 0))], LIMITS, 0.01
    )
    times = np.linspace(-0.1, motion.duration + 0.1, 50)
    forward = [motion.at(t) for t in times]
    backward = [motion.at(t) for t in reversed(times)][::-1]
    assert all(close(a.pose, b.pose, 1e-15) for a, b in zip(forward, backward, strict=True))


def test_no_way_takes_no_time_and_holds():
    here = Pose.of((0.1, 0.2, 0.3))
    motion = path_through([here, here], LIMITS, 0.01)
    assert motion.duration == 0.0
    assert close(motion.at(1.0).pose, here)
