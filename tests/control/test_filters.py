"""Filters and limits: rates always hold, lags do not depend on the control rate."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from rig import Bench

from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.filters import lag_share, step_lag
from skillc_runtime.control.limits import JointLimit, TorqueLimit

values = arrays(float, 3, elements=st.floats(-100, 100))


@given(values, values, st.floats(0.01, 1.0))
def test_a_lag_behaves_alike_at_every_rate(start, target, time_constant):
    results = []
    for rate in (100, 250, 1000):
        value = start.copy()
        for _ in range(rate // 2):
            step_lag(value, target, lag_share(1 / rate, time_constant), 0.0)
        results.append(value)
    assert np.allclose(results, target + np.exp(-0.5 / time_constant) * (start - target))


def test_a_lag_without_time_passes_everything_and_a_slow_one_arrives():
    value = np.zeros(2)
    step_lag(value, np.ones(2), lag_share(0.001, 0.0), 1e-6)
    assert value.tolist() == [1.0, 1.0]
    slow = np.zeros(2)
    arrived = [step_lag(slow, np.ones(2), lag_share(0.001, 0.1), 1e-3) for _ in range(800)]
    assert slow.tolist() == [1.0, 1.0]
    assert arrived == sorted(arrived) and not arrived[0]


@pytest.fixture(scope="module")
def iiwa() -> Bench:
    return Bench("iiwa14")


@pytest.fixture(scope="module")
def ur5e() -> Bench:
    return Bench("ur5e")


@given(wanted=arrays(float, (10, 7), elements=st.floats(-1e5, 1e5)))
def test_torques_stay_within_rate_and_effort(iiwa, wanted):
    state, limit = iiwa.state(), TorqueLimit(iiwa.limits, 1000.0)
    before = state.bias
    for tau in wanted:
        now = limit.step(tau, state, 0.001)
        assert (np.abs(now) <= iiwa.limits.effort).all()
        assert (np.abs(now - before) <= 1.0 + 1e-9).all()
        before = now


def test_a_joint_near_the_end_of_its_range_is_pushed_back():
    bench = Bench("iiwa14")
    bench.data.qpos[1] = bench.limits.range[1, 1]
    tau = TorqueLimit(bench.limits, 1000.0).step(np.zeros(7), bench.state(), 0.001)
    assert tau[1] - bench.data.qfrc_bias[1] == pytest.approx(-bench.limits.effort[1] / 4)


@given(wanted=arrays(float, (10, 6), elements=st.floats(-10, 10)))
def test_joint_positions_stay_within_speed_and_range(ur5e, wanted):
    state = ur5e.state()
    limit, before = JointLimit(ur5e.limits, state.q), state.q
    for q in wanted:
        now = limit.step(q, state, 0.001).q
        assert (np.abs(now - before) <= ur5e.limits.velocity * 0.001 + 1e-12).all()
        assert (now >= ur5e.limits.range[:, 0]).all()
        assert (now <= ur5e.limits.range[:, 1]).all()
        before = now


def test_an_arm_that_does_not_follow_is_noticed(ur5e):
    state = ur5e.state()
    limit = JointLimit(ur5e.limits, state.q + 0.3)
    with pytest.raises(ControlError, match=r"0\.30 rad"):
        limit.step(state.q, state, 0.001)
    assert (limit.step(state.q, state, 0.001).q == state.q).all()
