"""The connection to one arm: what it reads and commands, and in which words it says what is wrong on the graph."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import monotonic, sleep
from typing import Any

import numpy as np
import pytest

from robots.ros2.nodes import offer, spun
from robots.ros2.running import Robot, robot
from simulation.cells import vocabulary
from skillc_ontology import catalogue
from skillc_runtime.backends.control_process.link import (
    KINDS,
    ControlRefused,
    LinkLost,
    make_command,
    make_state,
)
from skillc_runtime.backends.ros2.arms.joint_commands import ask_controller
from skillc_runtime.backends.ros2.arms.link import Ros2Description, Ros2Link
from skillc_runtime.backends.ros2.facts import ArmInterface, Services, read_arm
from skillc_runtime.backends.ros2.session import Session, find_message
from skillc_runtime.devices.arm import Mode
from skillc_runtime.devices.backend import BackendUnavailable
from skillc_runtime.scene.load import load_scene
from waiting import LONG_S

pytestmark = pytest.mark.slow

SCENE = Path(__file__).with_name("cell.ttl")
MODEL_JOINTS = ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")
IN_ROS = {name: f"{name}_joint" for name in MODEL_JOINTS}
TELLING = {"described": True, "shuffled": True}
"""The robot publishes its URDF, and its controller has its joints as a parameter, in another order than the model's."""
HOME = [0.0, -1.9, 2.2, -1.87, -1.5708, 0.0]


def facts(mode: Mode = "position", **changed: Any) -> ArmInterface:
    state = load_scene(SCENE, vocabulary())
    return replace(read_arm(state, "http://example.org/lab#Arm-1", MODEL_JOINTS, mode), **changed)


@contextmanager
def link_of(interface: ArmInterface) -> Iterator[Ros2Link]:
    link = Ros2Description(interface, str(catalogue.model_path("robots/ur5e.xml"))).make_link()
    try:
        link.connect()
        yield link
    finally:
        link.close()


@pytest.fixture(scope="module")
def there(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Robot]:
    """Return a robot whose driver takes positions, and publishes its joints in another order than the model's."""
    with robot(
        SCENE, tmp_path_factory.mktemp("robot"), rate_hz=125, reverse=True, joint_names=IN_ROS, **TELLING
    ) as found:
        yield found


def wait_until(link: Ros2Link, holds: Callable[[], bool], seconds: float = LONG_S) -> None:
    """Read until something holds."""
    state, end = make_state(6), monotonic() + seconds
    while not holds():
        assert monotonic() < end
        link.read(state)


def test_joints_go_where_they_are_commanded_whatever_their_order_on_the_topic(there: Robot) -> None:
    state, command = make_state(6), make_command(6)
    with link_of(facts()) as link:
        link.read(state)
        assert state.q == pytest.approx(HOME, abs=0.02)
        assert np.isfinite(state.wrench).all()
        link.take_control("position")
        assert link.condition.kind == "in-control"
        command.kind[0] = KINDS.index("position")
        start = state.q.copy()
        for goal in (start + 0.1 * np.arange(6) * [1, 1, 1, -1, -1, -1], start):
            for share in np.linspace(0.0, 1.0, 150):
                link.read(state)
                command.values[:] = start + share * (goal - start)
                link.write(command)
            wait_until(link, partial(_is_at, link, goal))
            start = goal
        link.give_back()
        assert link.condition.kind == "ready"


def _is_at(link: Ros2Link, goal: Any) -> bool:
    link.read(state := make_state(6))
    return bool(np.allclose(state.q, goal, atol=0.01))


def test_a_silent_robot_is_lost_by_the_name_of_its_topic_and_found_again(there: Robot) -> None:
    with link_of(facts()) as link:
        there.pause()
        try:
            with pytest.raises(LinkLost, match=r"/(joint_states|\w+/wrench) has been silent for \d\.\d\d s"):
                wait_until(link, lambda: False)
        finally:
            there.go_on()
        link.connect()
        link.read(state := make_state(6))
        assert np.isfinite(state.q).all()


def test_joints_of_other_names_are_listed_with_those_that_are_there(there: Robot) -> None:
    wrong = facts(joints=MODEL_JOINTS, timing=replace(facts().timing, connect_s=3.0))
    with (
        pytest.raises(BackendUnavailable, match=r"/joint_states has no shoulder_pan, .*but .*shoulder_pan_joint"),
        link_of(wrong),
    ):
        pass


def test_joints_that_are_exchanged_in_the_facts_are_found_before_anything_moves(there: Robot) -> None:
    pan, lift, *others = facts().joints
    wrong = facts(joints=(lift, pan, *others))
    with pytest.raises(BackendUnavailable, match=r"by /robot_description, .* turns about another axis"), link_of(wrong):
        pass


def test_a_controller_of_other_joints_or_of_other_commands_is_named(there: Robot) -> None:
    session = Session("asks")
    try:
        wait_until_true(lambda: bool(ask_controller(session, facts().command).joints))
        controller = ask_controller(session, facts().command)
    finally:
        session.close()
    assert controller.joints == facts().joints[::-1]
    assert controller.find_problem(facts().joints, "position") is None
    assert "takes position commands; the law of the arm gives velocity" in str(
        controller.find_problem(facts().joints, "velocity")
    )
    assert "those of the facts are a, b (ros2:jointNames)" in str(controller.find_problem(("a", "b"), "position"))


def wait_until_true(holds: Callable[[], bool], seconds: float = LONG_S) -> None:
    end = monotonic() + seconds
    while not holds():
        assert monotonic() < end
        sleep(0.05)


def test_a_topic_that_nobody_publishes_or_that_has_another_type_is_named(there: Robot) -> None:
    soon = replace(facts().timing, connect_s=3.0)
    with (
        pytest.raises(BackendUnavailable, match=r"nobody publishes /arm/joint_states .*; there are /joint_states"),
        link_of(facts(states="/arm/joint_states", timing=soon)),
    ):
        pass
    with (
        pytest.raises(
            BackendUnavailable, match=r"/odd has messages of std_msgs/msg/Bool, not of sensor_msgs/msg/JointState"
        ),
        talker("/odd", "std_msgs/msg/Bool"),
        link_of(facts(states="/odd", timing=soon)),
    ):
        pass


@contextmanager
def talker(topic: str, kind: str) -> Iterator[Any]:
    """Have another node that publishes a topic."""
    session = Session("somebody_else")
    try:
        yield session.publish(topic, kind, reliable=True)
    finally:
        session.close()


def test_a_second_program_that_commands_the_arm_is_named(there: Robot) -> None:
    with link_of(facts()) as link, talker("/forward_position_controller/commands", "std_msgs/msg/Float64MultiArray"):
        wait_until(link, lambda: link.condition.kind == "not-in-control")
        who = "somebody_else publishes commands to /forward_position_controller/commands as well"
        wait_until(link, lambda: who in link.condition.sentence)
        with pytest.raises(ControlRefused, match="somebody_else"):
            link.take_control("position")


def test_a_controller_that_is_not_active_is_named(there: Robot) -> None:
    with (
        link_of(facts("velocity")) as link,
        pytest.raises(ControlRefused, match=r"nobody subscribes to /forward_velocity_controller/commands"),
    ):
        link.take_control("velocity")


def test_a_program_that_has_stopped_is_a_protective_stop_until_it_is_sent_again(there: Robot) -> None:
    with link_of(facts()) as link:
        link.take_control("position")
        wait_until(link, lambda: link.condition.kind == "in-control")
        session = Session("operator")
        assert session.call("/stop_program", 5.0) is None
        session.close()
        wait_until(link, lambda: link.condition.kind == "protective-stop")
        assert "/robot_program_running says" in link.condition.sentence
        link.recover()
        wait_until(link, lambda: link.condition.kind in ("ready", "in-control"))


def test_the_sensor_is_tared_by_the_service_of_its_driver(there: Robot) -> None:
    with link_of(facts(services=Services(tare="/zero_sensor"))) as link:
        assert link.abilities.tares
        with pytest.raises(LinkLost, match="nobody offers the service /zero_sensor"):
            link.tare()
        called, driver = list[str](), Session("driver")
        try:
            offer(driver, "/zero_sensor", lambda: called.append("tared") or "")
            with spun(driver):
                wait_until(link, lambda: bool(_tare(link)))
        finally:
            driver.close()
        assert called == ["tared"]


def _tare(link: Ros2Link) -> bool:
    try:
        link.tare()
    except LinkLost:
        return False
    return True


def test_messages_are_those_of_ros() -> None:
    assert find_message("sensor_msgs/msg/JointState").__name__ == "JointState"
    with pytest.raises(BackendUnavailable, match=r"has no no_msgs/msg/No .*: install its package no_msgs"):
        find_message("no_msgs/msg/No")


def test_nothing_was_commanded_beyond_limits(there: Robot) -> None:
    found = there.end()
    assert found["commands"] > 100
    assert (found["beyond_limits"], found["examples"]) == (0, [])
