"""Dwell at the corners of lanes, of motions that are made up."""

from __future__ import annotations

import numpy as np
import pytest

from skillc_runtime.backends.simulation.truth.recorder import COLUMNS
from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.evaluation.metrics.lane_dwell import measure_lane_dwell
from skillc_runtime.motion.lanes import plan_lanes
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Array

STEP_S = 0.001
SPEED, ACCELERATION = 0.1, 0.4
BOARD, ERASER = np.array([0.40, 0.30]), np.array([0.10, 0.05])


def recording(path_velocity: Array, velocity: Array, overlay: Array | float = 0.0) -> Recording:
    rows = np.zeros((len(velocity), COLUMNS))
    rows[:, 0] = np.arange(len(velocity)) * STEP_S
    rows[:, 9:12], rows[:, 15:18], rows[:, 21:24] = velocity, path_velocity + overlay, path_velocity
    return Recording(rows)


def wiping(blend: float) -> Array:
    """Return the velocity (n, 3) along lanes whose corners are cut by `blend` m."""
    motion = path_through(plan_lanes(BOARD, ERASER, 0.2), MotionLimits(SPEED, ACCELERATION), blend)
    times = np.arange(0.0, motion.duration, STEP_S)
    return np.array([motion.at(float(time)).twist[:3] for time in times])


def turning(stand_s: float) -> Array:
    """Return the velocity (n, 3) of two lanes at a right angle, with a stop in between."""
    still = np.zeros((round(stand_s / STEP_S), 3))
    return np.concatenate([np.tile([SPEED, 0, 0], (2000, 1)), still, np.tile([0, SPEED, 0], (2000, 1))])


def test_a_stop_at_a_corner_is_dwell() -> None:
    found = measure_lane_dwell(recording(turning(0.3), turning(0.3)))
    assert found is not None
    assert (found.seconds, found.of) == (pytest.approx(0.3), "tool")


def test_turning_round_is_two_corners() -> None:
    there = np.tile([SPEED, 0, 0], (1000, 1))
    velocity = np.concatenate([there, np.zeros((200, 3)), -there])
    found = measure_lane_dwell(recording(velocity, velocity))
    assert found is not None
    assert found.seconds == pytest.approx(0.1)


def test_lanes_that_stop_dwell_as_long_as_braking_takes_and_blended_ones_do_not() -> None:
    stopping, blended = wiping(0.0), wiping(0.01)
    slow, swift = measure_lane_dwell(recording(stopping, stopping)), measure_lane_dwell(recording(blended, blended))
    assert slow is not None and swift is not None
    assert slow.seconds == pytest.approx(SPEED / ACCELERATION, rel=0.05), "v/2 is left and reached again in v/a"
    assert swift.seconds == 0.0


def test_start_and_end_are_no_dwell() -> None:
    rest = np.zeros((500, 3))
    velocity = np.concatenate([rest, turning(0.0), rest])
    found = measure_lane_dwell(recording(velocity, velocity))
    assert found is not None
    assert found.seconds == 0.0


def test_it_is_the_tool_that_is_measured_unless_an_overlay_hides_it() -> None:
    lagging = recording(turning(0.1), turning(0.1) + np.array([0.0, 0.0, 0.001]))
    overlaid = recording(turning(0.1), np.zeros_like(turning(0.1)), overlay=np.array([0.0, 0.09, 0.0]))
    found = [measure_lane_dwell(each) for each in (lagging, overlaid)]
    assert [each.of for each in found if each] == ["tool", "path"]
    assert [each.seconds for each in found if each] == pytest.approx([0.1, 0.1])
    assert measure_lane_dwell(recording(turning(0.1), np.zeros_like(turning(0.1)))) is None, (
        "a tool that never gets going"
    )


def test_a_straight_lane_has_no_corner() -> None:
    velocity = np.tile([SPEED, 0, 0], (1000, 1))
    assert measure_lane_dwell(recording(velocity, velocity)) is None
