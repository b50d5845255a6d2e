"""Compares the facts of the devices besides arms with what ROS 2 has: topics, services and actions that are missing."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeAlias

from skillc_runtime.backends.ros2.camera import IMAGE, INFO
from skillc_runtime.backends.ros2.device_facts import DeviceFacts
from skillc_runtime.backends.ros2.devices import joints_of
from skillc_runtime.backends.ros2.facts import (
    ARRAY,
    GripperInterface,
    read_base,
    read_camera,
    read_gripper,
    read_inspected,
)
from skillc_runtime.backends.ros2.inspection import SHARE
from skillc_runtime.backends.ros2.session import Session, describe_topic
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.world.state.world_state import WorldState

Topic: TypeAlias = tuple[str, str, bool]
"""A topic with its type, and whether the device publishes it; else it takes its messages."""


def check_devices(state: WorldState, scene: SceneSpec, session: Session) -> Iterator[str]:
    """Yield a sentence for each topic, service or action that nobody offers, or that has another type."""
    for arm in scene.arms:
        if arm.gripper is not None:
            hand = read_gripper(state, arm.gripper.individual, joints_of(str(arm.gripper.model)))
            yield from (f"{hand.name}: {each}" for each in _check_gripper(hand, session))
    for name, topics in _find_topics(state, scene):
        yield from (f"{name}: {each}" for each in check_topics(topics, session))


def _check_gripper(facts: GripperInterface, session: Session) -> Iterator[str]:
    yield from check_topics([(facts.states, "sensor_msgs/msg/JointState", True)], session)
    if facts.open_service:
        yield from check_services((facts.open_service, facts.close_service), session)
    elif facts.command_type == ARRAY:
        yield from check_topics([(each, ARRAY, False) for each in (facts.command, facts.effort)], session)
    elif f"{facts.command}/_action/send_goal" not in dict(session.node.get_service_names_and_types()):
        yield f"nobody offers the action {facts.command} ({facts.command_type})"


def _find_topics(state: WorldState, scene: SceneSpec) -> Iterator[tuple[str, list[Topic]]]:
    """Yield the other devices by name, with the topics of each; empty names for those that it does not have."""
    for each in scene.bases:
        base = read_base(state, each.individual)
        goal = (base.goal, "geometry_msgs/msg/PoseStamped", False)
        yield base.name, [(base.odometry, "nav_msgs/msg/Odometry", True), goal]
    for spec in scene.cameras:
        if (camera := read_camera(state, spec.individual)) is not None:
            depths = [(camera.depth, IMAGE, True), (camera.info, INFO, True)] if camera.depth else []
            yield camera.name, [(camera.image, IMAGE, True), *depths]
    for fixture in scene.fixtures:
        facts = DeviceFacts(state, fixture.individual)
        yield facts.name, [(facts.topic("switchedTopic"), "std_msgs/msg/Bool", True)]
    for surface, share in read_inspected(state).items():
        yield state.vocabulary.short(surface), [(share.topic, SHARE, True)]


def check_topics(topics: Iterable[Topic], session: Session) -> Iterator[str]:
    """Yield a sentence for each topic that is not there; empty names are left out."""
    for topic, kind, offered in topics:
        ends = session.node.get_publishers_info_by_topic if offered else session.node.get_subscriptions_info_by_topic
        if topic and kind not in {each.topic_type for each in ends(topic)}:
            yield describe_topic(session.node, topic, kind, offered)


def check_services(services: Iterable[str], session: Session) -> Iterator[str]:
    """Yield a sentence for each service that nobody offers; empty names are left out."""
    there = dict(session.node.get_service_names_and_types())
    for service in filter(None, services):
        if "std_srvs/srv/Trigger" not in there.get(service, ()):
            yield f"nobody offers the service {service} (std_srvs/srv/Trigger)"
