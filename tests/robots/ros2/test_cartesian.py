"""An arm whose law runs on the robot's side: what skills ask of the tool arrives there as pose, stiffness, wrench."""

from __future__ import annotations

from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
import pytest

from robots.ros2 import scenes
from robots.ros2.running import robot
from robots.ros2.test_cell import LIMITS, advance_until, opened
from simulation.cells import LAB
from skillc_runtime.backends.ros2.session import Session, Subscription
from skillc_runtime.devices.guarded_push import GuardedPush, Travel
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.pose import Pose

pytestmark = [pytest.mark.slow, pytest.mark.long]

ARM, BELOW, WRENCH = LAB + "Iiwa-1", "/cartesian_controller/", "geometry_msgs/msg/WrenchStamped"
FORCE_N, WAY_M = 6.0, 0.03


def newest(session: Session, topic: Subscription) -> Any:
    """Return the newest of the messages of a topic that come within a while, as six numbers."""
    end, found = monotonic() + 0.3, None
    while monotonic() < end or found is None:
        session.wait(0.05)
        while (message := topic.take()) is not None:
            force, torque = message.wrench.force, message.wrench.torque
            found = np.array([force.x, force.y, force.z, torque.x, torque.y, torque.z])
        assert monotonic() < end + 30.0
    return found


def test_the_tool_moves_yields_and_pushes_by_the_controller_of_the_robot(tmp_path: Path) -> None:
    scene = scenes.cartesian_table(tmp_path)
    with robot(scene, tmp_path, rate_hz=250, control="cartesian") as there, opened(scene) as cell:
        arm, session = cell.arm(ARM), Session("listener")
        stiffness, wrench = (
            session.subscribe(BELOW + name, WRENCH, reliable=True)
            for name in ("set_cartesian_stiffness", "set_cartesian_wrench")
        )
        assert cell.stops.report is None
        start = arm.motion.stopping_pose()
        goal = Pose(start.position + 0.05, start.rotation)
        arm.motion.move_along(path_through([start, goal], LIMITS))
        advance_until(cell, lambda: arm.motion.done)
        advance_until(cell, lambda: bool(np.abs(arm.measured.pose.position - goal.position).max() < 0.005))
        assert newest(session, stiffness) == pytest.approx([1500.0] * 3 + [200.0] * 3, rel=0.01)

        up = np.array([0.0, 0.0, 1.0])
        arm.compliance.release(up)
        push = arm.compliance.start_push(GuardedPush(up, FORCE_N, 0.02, Travel(WAY_M)))
        advance_until(cell, lambda: bool(arm.measured.pose.position[2] < goal.position[2] - WAY_M / 4))
        assert newest(session, stiffness)[:3] == pytest.approx([1500.0, 1500.0, 0.0], abs=30.0)
        advance_until(cell, lambda: arm.take_fault() is not None)
        assert push.pressed_s is None, "there is nothing to push on"
        assert arm.measured.pose.position[2] == pytest.approx(goal.position[2] - WAY_M, abs=0.02)
        assert arm.measured.pose.position[:2] == pytest.approx(goal.position[:2], abs=0.01)
        arm.compliance.end_push(push)
        arm.compliance.restore()
        advance_until(cell, lambda: cell.is_at_rest())
        assert newest(session, stiffness)[2] == pytest.approx(1500.0, rel=0.05)
        assert np.abs(newest(session, wrench)).max() < 1.0
        session.close()
        report = there.end()
    assert report["commands"] > 100
    assert (report["beyond_limits"], report["examples"]) == (0, [])
