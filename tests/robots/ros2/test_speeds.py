"""Controllers of speeds go on with the last one: whoever loses control has to stop them first."""

from __future__ import annotations

from pathlib import Path

import pytest

from robots.ros2.running import robot
from robots.ros2.test_link import IN_ROS, SCENE, facts, link_of, talker, wait_until
from skillc_runtime.backends.control_process.link import KINDS, make_command, make_state

pytestmark = [pytest.mark.slow, pytest.mark.long]


def test_speeds_do_not_go_on_when_control_is_lost(tmp_path: Path) -> None:
    state, command = make_state(6), make_command(6)
    command.kind[0] = KINDS.index("velocity")
    command.values[:] = [0.2, 0.0, 0.0, 0.0, 0.0, 0.0]
    topic = "/forward_velocity_controller/commands"
    with (
        robot(SCENE, tmp_path, rate_hz=125, control="velocity", joint_names=IN_ROS),
        link_of(facts("velocity")) as link,
    ):
        link.take_control("velocity")
        for _ in range(100):
            link.read(state)
            link.write(command)
        assert state.dq[0] == pytest.approx(0.2, abs=0.05)
        with talker(topic, "std_msgs/msg/Float64MultiArray"):
            wait_until(link, lambda: link.condition.kind == "not-in-control")
            for _ in range(100):
                link.read(state)
        assert state.dq[0] == pytest.approx(0.0, abs=0.01)
