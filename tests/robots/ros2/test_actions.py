"""Joints by an action of control_msgs, where it is: goals of one point each, as fast as a server accepts them."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest

from robots.ros2.nodes import spun, wait_until
from robots.ros2.test_link import HOME, facts
from skillc_ontology import catalogue
from skillc_runtime.backends.control_process.link import make_command
from skillc_runtime.backends.ros2.arms.tool_commands import make_commands
from skillc_runtime.backends.ros2.facts import FOLLOW
from skillc_runtime.backends.ros2.goal_client import GoalClient
from skillc_runtime.backends.ros2.session import Session, find_message

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(find_spec("control_msgs") is None, reason="there is no control_msgs: source an installed ROS 2"),
]

NAME, MODEL = "/scaled/follow_joint_trajectory", str(catalogue.model_path("robots/ur5e.xml"))


class Server:
    """A controller that takes the newest goal, and gives it up or refuses it as the test sets."""

    def __init__(self, session: Session) -> None:
        from rclpy.action import ActionServer, GoalResponse

        self.goals: list[Any] = []
        self.refuses, self.gives_up = False, ""
        made = find_message(FOLLOW)

        def accept(_: Any) -> Any:
            return GoalResponse.REJECT if self.refuses else GoalResponse.ACCEPT

        def follow(handle: Any) -> Any:
            self.goals.append(handle.request.trajectory)
            result = made.Result(error_string=self.gives_up)
            (handle.abort if self.gives_up else handle.succeed)()
            return result

        server = ActionServer(session.node, made, NAME, follow, goal_callback=accept)
        session.closing.append(server.destroy)


def test_joints_follow_goals_until_the_server_gives_up_or_refuses(other: Session) -> None:
    server, asks, command = Server(other), Session("asks"), make_command(6)
    commands = make_commands(facts(command=NAME, command_type=FOLLOW), MODEL, asks)
    values = np.array(HOME)
    problems: list[str] = []

    def send() -> None:
        values[0] += 0.001
        command.values[:] = values
        problems.extend(filter(None, [commands.send("position", command)]))

    try:
        with spun(other):
            wait_until(lambda: commands.find_obstacle() is None)
            assert commands.fit() is None, "the controller has no parameters"
            wait_until(lambda: len(server.goals) > 5, send)
            assert problems == []
            goal = server.goals[-1]
            assert tuple(goal.joint_names) == facts().joints
            assert goal.points[0].positions[1:] == pytest.approx(HOME[1:])
            assert 0 < goal.points[0].time_from_start.nanosec <= 200_000_000
            server.gives_up = "wrist_1 is too far behind"
            wait_until(lambda: problems, send)
            assert problems[0] == f"{NAME} has given up a goal: wrist_1 is too far behind"
            server.gives_up, server.refuses = "", True
            problems.clear()
            commands.begin(values)
            wait_until(lambda: problems and "refused" in problems[-1], send)
            second = GoalClient(other, NAME, FOLLOW)
            wait_until(lambda: (found := commands.find_obstacle()) and found.kind == "not-in-control")
            del second
    finally:
        asks.close()
