"""Joint motions: synchronised, within every limit, exact ends."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from skillc_runtime.motion.paths.joint import joint_motion

joints = st.lists(st.floats(-3.0, 3.0), min_size=6, max_size=6).map(np.array)


@given(joints, joints, st.floats(0.0, 1.0))
def test_limits_and_ends(start, goal, share):
    speed, acceleration = np.linspace(0.5, 2.0, 6), np.linspace(1.0, 6.0, 6)
    motion = joint_motion(start, goal, speed, acceleration)
    now = motion.at(share * motion.duration)
    assert (np.abs(now.dq) <= speed + 1e-9).all()
    assert (np.abs(now.ddq) <= acceleration + 1e-9).all()
    assert np.allclose(motion.at(0.0).q, start)
    assert np.allclose(motion.at(motion.duration).q, goal, atol=1e-8)


def test_one_joint_is_at_a_limit():
    motion = joint_motion(np.zeros(2), np.array([1.0, 0.1]), np.array([0.5, 0.5]), np.array([1.0, 1.0]))
    assert np.allclose(motion.at(motion.duration / 2).dq, [0.5, 0.05])
