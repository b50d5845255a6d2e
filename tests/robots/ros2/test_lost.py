"""Robots that have died, and robots that are not what the facts say: nothing of theirs is moved."""

from __future__ import annotations

from pathlib import Path

import pytest

from robots.ros2.running import robot
from robots.ros2.test_cell import opened, wait_for_stop
from robots.ros2.test_link import IN_ROS, SCENE
from skillc_runtime.devices.backend import StopPersists

pytestmark = [pytest.mark.slow, pytest.mark.long]


def test_a_robot_that_has_died_stops_the_cell_until_it_is_there_again(tmp_path: Path) -> None:
    with robot(SCENE, tmp_path, rate_hz=125, joint_names=IN_ROS) as there, opened() as cell:
        there.kill()
        assert "has been silent for" in wait_for_stop(cell)
        with pytest.raises(StopPersists, match="does not answer"):
            cell.stops.clear()
        assert cell.is_at_rest()


def test_a_robot_that_speaks_of_degrees_is_never_moved(tmp_path: Path) -> None:
    with robot(SCENE, tmp_path, rate_hz=125, joint_names=IN_ROS, degrees=True) as there:
        with opened() as cell:
            assert "beyond the end of its range" in wait_for_stop(cell)
        assert there.end()["commands"] == 0
