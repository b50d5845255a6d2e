"""Compares the facts of a scene with what ROS 2 has now: what is missing, has another type or rate, or contradicts."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from time import monotonic
from typing import Any

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
from skillc_runtime.backends.ros2.cell import describe
from skillc_runtime.backends.ros2.description import Description
from skillc_runtime.backends.ros2.device_check import check_devices, check_services
from skillc_runtime.backends.ros2.facts import ArmInterface
from skillc_runtime.backends.ros2.place_check import check_places
from skillc_runtime.backends.ros2.session import Session, Subscription, describe_topic
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, read_scene_spec
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.world_state import WorldState

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
    yield from check_services((services.recover, services.tare), session)


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
