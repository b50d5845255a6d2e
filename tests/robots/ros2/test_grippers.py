"""Grippers by actions and services that a node of ROS 2 offers; control_msgs is used where it is."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest

from robots.ros2.nodes import offer, receiving, spun, wait_until
from robots.ros2.test_link import SCENE
from simulation.cells import LAB, vocabulary
from skillc_runtime.backends.ros2.facts import GRIP, GRIP_BY_NAMES, read_gripper
from skillc_runtime.backends.ros2.gripper import Ros2Gripper
from skillc_runtime.backends.ros2.session import Session, find_message
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.motion.pose import Pose
from skillc_runtime.scene.load import load_scene

pytestmark = pytest.mark.slow

needs_control = pytest.mark.skipif(
    find_spec("control_msgs") is None, reason="there is no control_msgs: source an installed ROS 2"
)


class Fingers:
    """A gripper by an action: a server that has its fingers half closed when they touch a thing."""

    def __init__(self, session: Session, kind: str) -> None:
        from rclpy.action import ActionServer

        self.forces: list[float] = []
        self.stalls_at, self.at = 0.0, 0.055
        self._session, self._named = session, kind == GRIP_BY_NAMES
        self._states = session.publish("/joint_states", "sensor_msgs/msg/JointState", reliable=True)
        made = find_message(kind)
        server = ActionServer(session.node, made, "/gripper_controller/gripper_cmd", self._move)
        session.closing.append(server.destroy)
        self._made = made

    def _move(self, handle: Any) -> Any:
        command, result = handle.request.command, self._made.Result()
        self.forces.append(command.effort[0] if self._named else command.max_effort)
        goal = command.position[0] if self._named else command.position
        self.at = max(goal, self.stalls_at)
        result.stalled, result.reached_goal = goal < self.stalls_at, goal >= self.stalls_at
        (handle.succeed if goal >= 0 else handle.abort)()
        return result

    def tell(self) -> None:
        """Publish where the fingers are."""
        names = ["left_finger", "right_finger"]
        self._states.publish(self._states.msg_type(name=names, position=[self.at] * 2))


class Arm:
    """The arm of a gripper, with what it holds."""

    def __init__(self) -> None:
        self.held: list[str] = []

    def hold(self, thing: str, *_: object) -> None:
        self.held.append(thing)

    def set_load(self, load: None) -> None:
        self.held.clear()


@needs_control
@pytest.mark.parametrize("kind", [GRIP, GRIP_BY_NAMES])
def test_a_gripper_by_an_action_closes_around_a_thing(kind: str, other: Session, tmp_path: Any) -> None:
    path = tmp_path / "cell.ttl"
    path.write_text(SCENE.read_text("utf-8") + f'lab:Hand-1 ros2:commandType "{kind}" .\n', "utf-8")
    state = load_scene(path, vocabulary())
    spec = read_scene_spec(state).arms[0].gripper
    assert spec is not None
    facts, arm = read_gripper(state, LAB + "Hand-1", ("left_finger", "right_finger")), Arm()
    fingers = Fingers(other, kind)
    with spun(other), receiving(lambda receiver: Ros2Gripper(spec, facts, arm, receiver)) as hand:  # type: ignore[arg-type]
        wait_until(lambda: hand.opening_m == pytest.approx(0.11), fingers.tell)
        wait_until(lambda: hand._commands._action.find_obstacle() is None, fingers.tell)
        fingers.stalls_at = 0.02
        hand.move(0.0, 30.0)
        wait_until(lambda: hand.blocked, fingers.tell)
        assert hand.opening_m == pytest.approx(0.04)
        assert (fingers.forces, hand.fault) == ([30.0], None)
        hand.attach(LAB + "Box-1", Pose(np.zeros(3), np.eye(3)), 0.1)
        hand.move(0.08, 30.0)
        wait_until(lambda: not hand.moving and hand.opening_m == pytest.approx(0.08), fingers.tell)


def test_a_gripper_by_services_opens_and_closes_and_says_what_is_wrong(other: Session, tmp_path: Any) -> None:
    path, said = tmp_path / "cell.ttl", [""]
    path.write_text(
        SCENE.read_text("utf-8") + 'lab:Hand-1 ros2:openService "open" ; ros2:closeService "close" .\n', "utf-8"
    )
    state = load_scene(path, vocabulary())
    spec, facts = read_scene_spec(state).arms[0].gripper, read_gripper(state, LAB + "Hand-1", ("left_finger",))
    assert spec is not None
    states, at = other.publish("/joint_states", "sensor_msgs/msg/JointState", reliable=True), [0.055]

    def move(position: float) -> str:
        at[0] = position if not said[0] else at[0]
        return said[0]

    def tell() -> None:
        states.publish(states.msg_type(name=["left_finger"], position=at))

    offer(other, "/open", lambda: move(0.055))
    offer(other, "/close", lambda: move(0.02))
    with spun(other), receiving(lambda receiver: Ros2Gripper(spec, facts, Arm(), receiver)) as hand:  # type: ignore[arg-type]
        wait_until(lambda: hand.opening_m == pytest.approx(0.11), tell)
        hand.move(0.03, 30.0)
        wait_until(lambda: hand.blocked and hand.opening_m == pytest.approx(0.04), tell)
        hand.move(0.08, 30.0)
        wait_until(lambda: not hand.moving and hand.opening_m == pytest.approx(0.11), tell)
        said[0] = "there is no air"
        hand.move(0.0, 30.0)
        wait_until(lambda: hand.fault == "there is no air", tell)
        hand.recover()
        assert hand.fault is None
        said[0], at[0] = "", 55.0
        wait_until(lambda: "is 110.000 m open by its facts" in (hand.fault or ""), tell)
