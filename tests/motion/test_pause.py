"""A pause slows a motion down along its way, within the deceleration of the arm, and the motion goes on afterwards."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from skillc_runtime.motion.joint_reference_generator import JointReferenceGenerator
from skillc_runtime.motion.overlays import Circle
from skillc_runtime.motion.paths.joint import joint_motion
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose
from skillc_runtime.motion.reference_generator import ReferenceGenerator

DECELERATION = 0.5
START, CORNER, GOAL = Pose.of((0.0, 0.0, 0.0)), Pose.of((1.0, 0.0, 0.0)), Pose.of((1.0, 0.4, 0.0))
PERIOD = 0.001


def sampled(generator, since, until):
    """The references in every period, as positions and velocities (n, 3)."""
    references = [generator.sample(now) for now in np.arange(since, until, PERIOD)]
    return np.array([each.pose.position for each in references]), np.array([each.twist[:3] for each in references])


@settings(max_examples=25)
@given(speed=st.floats(0.05, 0.5), at=st.floats(0.0, 1.0), lasts=st.floats(0.01, 3.0))
@example(speed=0.5, at=0.6640625, lasts=1.0)  # goes on right before the corner, which is slower than the way after it
def test_a_pause_keeps_to_the_way_and_the_motion_ends_where_it_shall(speed, at, lasts):
    path = path_through([START, CORNER, GOAL], MotionLimits(speed, DECELERATION))
    generator = ReferenceGenerator(START, DECELERATION)
    generator.follow(path, 0.0)
    began = at * path.duration
    generator.pause(began)
    _, braking = sampled(generator, began, began + lasts)
    generator.resume(began + lasts)
    positions, going_on = sampled(generator, began + lasts, began + lasts + 2.0)
    changes = np.linalg.norm(np.diff(np.concatenate([braking, going_on]), axis=0), axis=1)
    assert changes.max(initial=0.0) <= 2.1 * DECELERATION * PERIOD
    assert all(min(abs(y), abs(x - 1.0)) < 1e-9 for x, y, _ in positions)
    end = generator.sample(began + lasts + path.duration + 5.0)
    assert np.allclose(end.pose.position, GOAL.position) and not end.twist.any()


@pytest.mark.parametrize(("speed", "stands_after"), [(0.1, 0.5), (0.4, 0.8), (0.5, 1.0)])
def test_a_fast_motion_takes_longer_to_stop(speed, stands_after):
    generator = ReferenceGenerator(START, DECELERATION)
    generator.follow(path_through([START, CORNER], MotionLimits(speed, DECELERATION)), 0.0)
    generator.pause(1.0)
    _, velocities = sampled(generator, 1.0, 1.0 + stands_after)
    assert np.abs(np.diff(velocities, axis=0)).max() <= DECELERATION * PERIOD * 1.001
    assert not generator.stationary(1.0 + stands_after - 0.01)
    assert generator.stationary(1.0 + stands_after + 0.01)
    assert not generator.done(100.0)


@settings(max_examples=25)
@given(share=st.floats(0.05, 1.0), stopped_at=st.floats(0.05, 0.95))
def test_a_slower_motion_goes_the_same_way_and_stops_as_soon_as_it_may(share, stopped_at):
    path = path_through([START, CORNER, GOAL], MotionLimits(0.4, DECELERATION))
    usual, slower = ReferenceGenerator(START, DECELERATION), ReferenceGenerator(START, DECELERATION)
    slower.set_speed(share, 0.0)
    for generator in (usual, slower):
        generator.follow(path, 10.0)
    for time in np.linspace(0.0, stopped_at * path.duration, 20):
        expected, found = usual.sample(10.0 + time), slower.sample(10.0 + time / share)
        assert np.allclose(found.pose.position, expected.pose.position, atol=1e-9)
        assert np.allclose(found.twist, share * expected.twist, atol=1e-9)
        assert np.allclose(found.acceleration, share**2 * expected.acceleration, atol=1e-9)
    speed, now = np.linalg.norm(found.twist[:3]), 10.0 + time / share
    rests_at = slower.stopping_pose(now).position
    slower.stop(now)
    _, braking = sampled(slower, now, now + speed / DECELERATION)
    changes = np.linalg.norm(np.diff(braking, axis=0), axis=1)
    assert changes.max(initial=0.0) <= 1.5 * DECELERATION * PERIOD
    assert slower.done(now + 1.5 * speed / DECELERATION + 1e-6)
    assert np.allclose(slower.sample(now + 10.0).pose.position, rests_at)


def test_slower_joints_stop_as_soon_as_they_may_and_go_on_after_a_pause():
    generator = JointReferenceGenerator(np.zeros(2), np.zeros(2), 1.0, 0.0, speed=0.25)
    motion = joint_motion(np.zeros(2), np.array([1.0, 0.5]), np.full(2, 1.0), np.full(2, 2.0))
    generator.follow(motion, 0.0)
    middle = generator.sample(2.0 * motion.duration)
    assert np.allclose(middle.q, motion.at(motion.duration / 2).q)
    assert np.allclose(middle.dq, 0.25 * motion.at(motion.duration / 2).dq)
    generator.pause(2.0 * motion.duration)
    assert generator.stationary(2.0 * motion.duration + 1.0)
    generator.resume(100.0)
    assert np.allclose(generator.sample(101.0).dq, middle.dq)
    generator.stop(101.0)
    assert generator.done(101.0 + np.abs(middle.dq).max() / 1.0 + 1e-6)


def test_an_overlay_pauses_with_its_motion_and_by_itself():
    generator = ReferenceGenerator(START, DECELERATION)
    handle = generator.add(Circle(0.02, 1.0), np.eye(3), 0.5, 0.0)
    assert not generator.stationary(1.0)
    generator.pause(1.0)
    assert not generator.stationary(1.2) and generator.stationary(2.0)
    assert np.array_equal(generator.sample(2.0).rows, generator.sample(9.0).rows)
    generator.resume(9.0)
    assert not generator.stationary(9.1)
    generator.pause(10.0)
    generator.remove(handle, 11.0)
    generator.sample(13.0)
    assert generator.at_rest(13.0)


def test_joints_pause_within_their_deceleration():
    speed = np.array([1.5, 0.5])
    motion = joint_motion(np.zeros(2), np.array([9.0, -3.0]), speed, np.full(2, 2.0))
    generator = JointReferenceGenerator(np.zeros(2), np.zeros(2), 1.0, 0.0)
    generator.follow(motion, 0.0)
    before = generator.sample(1.5).dq
    generator.pause(1.5)
    speeds = np.array([generator.sample(now).dq for now in np.arange(1.5, 4.0, PERIOD)])
    assert np.abs(before).max() == pytest.approx(1.5)
    assert np.abs(np.diff(speeds, axis=0)).max() <= 1.0 * PERIOD * 1.001
    assert generator.stationary(4.0) and not generator.done(4.0)
    generator.resume(4.0)
    assert np.allclose(generator.sample(20.0).q, [9.0, -3.0])
