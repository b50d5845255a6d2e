"""Compares the facts of a scene with what ROS 2 has now: what is missing, has another type or rate, or contradicts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from importlib.util import find_spec
from math import degrees
from pathlib import Path
from time import monotonic, sleep
from typing import Any, TypeAlias

import mujoco
import numpy as np

from skillc_runtime.backends.control_process.joint_doubts import (
    find_beyond,
    find_confusion,
    find_opposite_speeds,
    find_opposite_weights,
)
from skillc_runtime.backends.ros2.arms.joint_states import JointOrder
from skillc_runtime.backends.ros2.arms.tool_commands import make_commands
from skillc_runtime.backends.ros2.camera import IMAGE, INFO
from skillc_runtime.backends.ros2.cell import describe
from skillc_runtime.backends.ros2.description import Description
from skillc_runtime.backends.ros2.device_facts import DeviceFacts
from skillc_runtime.backends.ros2.devices import joints_of
from skillc_runtime.backends.ros2.facts import (
    ARRAY,
    LINKED,
    ArmInterface,
    GripperInterface,
    read_base,
    read_camera,
    read_gripper,
    read_inspected,
)
from skillc_runtime.backends.ros2.image_inspection import read_image_topics
from skillc_runtime.backends.ros2.inspection import SHARE
from skillc_runtime.backends.ros2.receiver import Receiver
from skillc_runtime.backends.ros2.session import Session, Subscription, describe_topic
from skillc_runtime.backends.ros2.transforms import Transforms
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.motion.pose import Array, log
from skillc_runtime.world.space.frame_tree import WORLD_FRAME
from skillc_runtime.world.state.world_state import WorldState

Topic: TypeAlias = tuple[str, str, bool]
"""A topic with its type, and whether the device publishes it; else it takes its messages."""

LOOK_S = 2.0
NEAR_M, NEAR_RAD = 0.02, 0.03

LOOK_S, FIND_S = 2.0, 4.0
"""How long messages are counted, after the first one was waited for so long at most, in s."""
RATE_SHARE = 0.2
"""By which share the rate of states may differ from that of the facts."""


class Listened:
    """When the messages of one topic came."""

    def __init__(self, subscription: Subscription) -> None:
        self.subscription, self.times = subscription, list[float]()

    @property
    def rate_hz(self) -> float:
        """How many messages there were a second; 0 for fewer than three."""
        return 0.0 if len(self.times) < 3 else (len(self.times) - 1) / (self.times[-1] - self.times[0])


def check_graph(state: WorldState) -> Iterator[str]:
    """Yield a sentence for each contradiction between a scene and ROS 2; SheetError, FrameError, BackendUnavailable."""
    scene = read_scene_spec(state)
    session = Session("skillc_check")
    try:
        for arm in scene.arms:
            interface = describe(arm).interface
            for each in _check_arm(arm, interface, session):
                yield f"{interface.name}: {each}"
        yield from check_devices(state, scene, session)
    finally:
        session.close()
    yield from check_places(state, scene)


def _check_arm(arm: ArmSpec, facts: ArmInterface, session: Session) -> Iterator[str]:
    order, first = JointOrder(facts.joints), None
    states = Listened(session.subscribe(facts.states, "sensor_msgs/msg/JointState", facts.quality.reliable_states))
    wrench = facts.wrench
    forces = wrench and Listened(
        session.subscribe(wrench.topic, "geometry_msgs/msg/WrenchStamped", facts.quality.reliable_states)
    )
    description, rows = Description(session, facts), list[Array]()
    until = monotonic() + FIND_S
    while monotonic() < until:
        session.wait(0.05)
        if forces:
            list(_take_all(forces))
        rows.extend(order.values.copy() for _ in _take_all(states, only_if=order.read))
        if rows and first is None:
            first, until = monotonic(), monotonic() + LOOK_S
    yield from _check_states(facts, states, order, session)
    if forces and not forces.times:
        yield describe_topic(session.node, forces.subscription.topic, forces.subscription.kind, offered=True)
    if rows and not order.missing:
        yield from _check_posture(arm, facts, np.array(rows))
        if (difference := description.find_difference(str(arm.model), order.positions)) is not None:
            yield difference
    yield from _check_commands(facts, str(arm.model), session)
    services = facts.services
    yield from _check_services((services.recover, services.tare), session)


def _take_all(listened: Listened, only_if: Any = lambda _: True) -> Iterator[Any]:
    """Yield the messages that have come, one after another, and count them."""
    while (message := listened.subscription.take()) is not None:
        if only_if(message):
            listened.times.append(monotonic())
            yield message


def _check_states(facts: ArmInterface, states: Listened, order: JointOrder, session: Session) -> Iterator[str]:
    if order.seen is None:
        yield describe_topic(session.node, facts.states, states.subscription.kind, offered=True)
        return
    if missing := order.describe_missing(facts.states):
        yield missing
    rate = states.rate_hz
    if rate and abs(rate - facts.rate_hz) > RATE_SHARE * facts.rate_hz:
        yield f"{facts.states} has {rate:.0f} messages a second; the facts say {facts.rate_hz:.0f} (ros2:updateRate)"


def _check_posture(arm: ArmSpec, facts: ArmInterface, rows: Array) -> Iterator[str]:
    """Yield what is wrong with units, order and signs of joints; rows (n, 3, nv): positions, speeds, torques."""
    model: Any = mujoco.MjModel.from_xml_path(str(Path(arm.model)))
    data = mujoco.MjData(model)
    q, _, effort = rows[-1]
    yield from find_opposite_speeds(facts.joints, rows[:, 0], rows[:, 1])
    if (beyond := find_beyond(facts.joints, q, model.jnt_range)) is not None:
        yield beyond
        return
    if (confusion := find_confusion(facts.joints, q, arm.home)) is not None:
        yield confusion
    if facts.mode == "torque":
        data.qpos[: q.size] = q
        mujoco.mj_forward(model, data)
        yield from find_opposite_weights(facts.joints, data.qfrc_bias[: q.size], effort)


def _check_commands(facts: ArmInterface, model: str, session: Session) -> Iterator[str]:
    commands = make_commands(facts, model, session)
    until = monotonic() + LOOK_S
    while (problem := commands.find_obstacle()) is not None and monotonic() < until:
        session.wait(0.05)
    found = commands.fit() if problem is None else problem.sentence
    if found is not None:
        yield found


def check_places(state: WorldState, scene: SceneSpec) -> Iterator[str]:
    """Yield a sentence for each arm whose base tf has elsewhere; nothing where there is no tf of it."""
    frames = {each.individual: str(frame) for each in scene.arms if (frame := state.value(each.individual, LINKED))}
    if not frames or find_spec("tf2_msgs") is None:
        return
    receiver = Receiver("skillc_check_frames")
    try:
        transforms = Transforms(receiver)
        receiver.begin()
        sleep(LOOK_S)
        with receiver.lock:  # wait ends: with the messages that have arrived
            found = {arm: transforms.find(frame, WORLD_FRAME) for arm, frame in frames.items()}
    finally:
        receiver.close()
    for arm in scene.arms:
        if (transform := found.get(arm.individual)) is None:
            continue
        away = float(np.linalg.norm(transform.pose.position - arm.base.position))
        turned = float(np.linalg.norm(log(transform.pose.rotation @ arm.base.rotation.T)))
        if away > NEAR_M or turned > NEAR_RAD:
            yield (
                f"{scene.names[arm.individual]}: tf has {frames[arm.individual]} {away:.2f} m and "
                f"{degrees(turned):.0f} deg from where the facts have the base of the arm"
            )


def check_devices(state: WorldState, scene: SceneSpec, session: Session) -> Iterator[str]:
    """Yield a sentence for each topic, service or action that nobody offers, or that has another type."""
    for arm in scene.arms:
        if arm.gripper is not None:
            hand = read_gripper(state, arm.gripper.individual, joints_of(str(arm.gripper.model)))
            yield from (f"{hand.name}: {each}" for each in _check_gripper(hand, session))
    for name, topics in _find_topics(state, scene):
        yield from (f"{name}: {each}" for each in _check_topics(topics, session))


def _check_gripper(facts: GripperInterface, session: Session) -> Iterator[str]:
    yield from _check_topics([(facts.states, "sensor_msgs/msg/JointState", True)], session)
    if facts.open_service:
        yield from _check_services((facts.open_service, facts.close_service), session)
    elif facts.command_type == ARRAY:
        yield from _check_topics([(each, ARRAY, False) for each in (facts.command, facts.effort)], session)
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
    if (topics := read_image_topics(state)) is not None:
        yield topics.name, [(topics.image, IMAGE, True), (topics.info, INFO, True)]
    for fixture in scene.fixtures:
        facts = DeviceFacts(state, fixture.individual)
        yield facts.name, [(facts.topic("switchedTopic"), "std_msgs/msg/Bool", True)]
    for surface, share in read_inspected(state).items():
        yield state.vocabulary.short(surface), [(share.topic, SHARE, True)]


def _check_topics(topics: Iterable[Topic], session: Session) -> Iterator[str]:
    """Yield a sentence for each topic that is not there; empty names are left out."""
    for topic, kind, offered in topics:
        ends = session.node.get_publishers_info_by_topic if offered else session.node.get_subscriptions_info_by_topic
        if topic and kind not in {each.topic_type for each in ends(topic)}:
            yield describe_topic(session.node, topic, kind, offered)


def _check_services(services: Iterable[str], session: Session) -> Iterator[str]:
    """Yield a sentence for each service that nobody offers; empty names are left out."""
    there = dict(session.node.get_service_names_and_types())
    for service in filter(None, services):
        if "std_srvs/srv/Trigger" not in there.get(service, ()):
            yield f"nobody offers the service {service} (std_srvs/srv/Trigger)"
