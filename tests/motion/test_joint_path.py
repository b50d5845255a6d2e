"""Joint motions through several postures: within every limit, through or past each, without a jump."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc_runtime.motion.joint_reference_generator import JointReferenceGenerator
from skillc_runtime.motion.paths.joint import joint_motion
from skillc_runtime.motion.paths.joint_path import joint_path

SPEED, ACCELERATION = np.linspace(0.5, 2.0, 6), np.linspace(1.0, 6.0, 6)

joints = st.lists(st.floats(-3.0, 3.0), min_size=6, max_size=6).map(np.array)
ways = st.lists(joints, min_size=2, max_size=6)


@given(ways, st.floats(0.0, 1.0))
@settings(max_examples=40)
def test_limits_ends_and_steadiness(way, blend):
    motion = joint_path(way, SPEED, ACCELERATION, [blend] * (len(way) - 2))
    times = np.linspace(0.0, motion.duration, 300)
    samples = [motion.at(float(time)) for time in times]
    assert (np.abs([now.dq for now in samples]) <= SPEED + 1e-9).all()
    assert (np.abs([now.ddq for now in samples]) <= ACCELERATION + 1e-9).all()
    moved = np.diff([now.q for now in samples], axis=0)
    assert (np.abs(moved) <= SPEED * np.diff(times)[:, None] + 1e-9).all()
    assert np.allclose(motion.at(0.0).q, way[0]) and np.allclose(motion.at(motion.duration).q, way[-1], atol=1e-8)
    assert np.allclose(motion.start, way[0]) and np.allclose(motion.end, way[-1])


@given(ways)
@settings(max_examples=40)
def test_without_blending_it_goes_through_every_posture_and_stops(way):
    motion = joint_path(way, SPEED, ACCELERATION, [0.0] * (len(way) - 2))
    for start, posture in zip(motion.starts, way, strict=False):
        assert np.allclose(motion.at(start).q, posture, atol=1e-8) and np.abs(motion.at(start).dq).max() < 1e-6


def test_blended_it_does_not_stop_and_is_sooner_there():
    way = [np.zeros(6), np.full(6, 1.0), np.array([2.0, 2.0, 2.0, 1.0, 1.0, 1.0])]
    stopping, passing = (joint_path(way, SPEED, ACCELERATION, [blend]) for blend in (0.0, 1.0))
    assert passing.duration < stopping.duration
    slowest = min(np.abs(passing.at(time).dq).max() for time in np.linspace(0.5, passing.duration - 0.5, 200))
    assert slowest > 0.1


def test_one_piece_is_the_straight_motion_itself():
    start, goal = np.linspace(-1.0, 1.0, 6), np.linspace(0.3, -2.0, 6)
    path, line = joint_path((start, goal), SPEED, ACCELERATION, ()), joint_motion(start, goal, SPEED, ACCELERATION)
    assert path.duration == line.duration > 0
    for time in np.linspace(0.0, line.duration, 20):
        assert (path.at(time).q == line.at(time).q).all() and (path.at(time).dq == line.at(time).dq).all()


@given(ways, st.floats(0.0, 1.0))
@settings(max_examples=20)
def test_an_arm_that_follows_it_gets_the_same_to_the_last_bit(way, blend):
    motion = joint_path(way, SPEED, ACCELERATION, [blend] * (len(way) - 2))
    generator = JointReferenceGenerator(way[0], np.zeros(6), 1.0, 0.0)
    generator.follow(motion, 0.0)
    times = map(float, (*motion.starts, *np.linspace(0.0, motion.duration, 50)))
    for time in (each for each in times if each < motion.duration):  # at the end it rests
        followed, wanted = generator.sample(time), motion.at(time)
        for part in ("q", "dq", "ddq"):
            assert (getattr(followed, part) == getattr(wanted, part)).all(), (part, time)
