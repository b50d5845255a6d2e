"""Nothing that is not a number passes the guard, in either direction; the arm then holds."""

import numpy as np
import pytest
from msgspec.structs import replace
from rig import HOMES, LAWS, Bench

from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.supervision.command_validator import CommandValidator
from skillc_runtime.devices.arm import JointPosition, Torque


def told(robot, values):
    return Torque(values) if LAWS[robot] == "impedance" else JointPosition(values)


def test_numbers_pass(robot):
    bench = Bench(robot)
    guard = CommandValidator(bench, bench.state())
    guard.check(bench.state())
    guard.command(told(robot, np.array(HOMES[robot]) + 0.01), 0.001)
    assert np.allclose(bench.data.ctrl, np.array(HOMES[robot]) + 0.01)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_bad_command_becomes_holding(robot, bad):
    bench = Bench(robot)
    state = bench.state()
    guard = CommandValidator(bench, state)
    with pytest.raises(ControlError, match="does not yield a number"):
        guard.command(told(robot, np.array([bad, *HOMES[robot][1:]])), 0.001)
    assert np.allclose(bench.data.ctrl, state.bias if LAWS[robot] == "impedance" else state.q)


@pytest.mark.parametrize("part", ["q", "dq", "wrench"])
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_bad_measurement_is_refused_wherever_it_is(robot, part, bad):
    bench = Bench(robot)
    state = bench.state()
    guard = CommandValidator(bench, state)
    broken = getattr(state, part).copy()
    broken[2] = bad
    with pytest.raises(ControlError, match="reports something"):
        guard.check(replace(state, **{part: broken}))
    assert np.isfinite(bench.data.ctrl).all()
