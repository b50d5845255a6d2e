"""Publishes the commands of one arm: joint values, trajectories of one point, or targets of a Cartesian controller."""

from __future__ import annotations

from typing import Protocol, TypeAlias

import numpy as np

from skillc_runtime.backends.control_process.link import CommandKind, CommandView, Condition
from skillc_runtime.backends.ros2.facts import ARRAY, TRAJECTORY, ArmInterface
from skillc_runtime.backends.ros2.flange import FlangeTurn
from skillc_runtime.backends.ros2.session import Session, describe_topic, find_message, name_nodes
from skillc_runtime.motion.arrays import OutVector
from skillc_runtime.motion.pose import Array


class Commands(Protocol):
    """What an arm is commanded through."""

    def begin(self, q: Array) -> None:
        """Prepare for commands, with the joints at q (nv,) in rad."""
        ...

    def send(self, kind: CommandKind, command: CommandView) -> str | None:
        """Publish a command; return why it cannot be expressed, or None."""
        ...

    def rest(self, q: Array) -> None:
        """Let the arm stand still, with the joints at q (nv,) in rad."""
        ...

    def find_obstacle(self) -> Condition | None:
        """Return why commands would have no effect, or contend with those of others."""
        ...

    def turn_to_flange(self, wrench: OutVector, q: Array) -> None:
        """Turn a wrench (6,) from the axes of the base to those of the flange, with the joints at q (nv,) in rad."""
        ...


class Target:
    """A topic that takes commands, and who else is there."""

    def __init__(self, session: Session, topic: str, kind: str, reliable: bool) -> None:
        self._node, self._topic, self._kind = session.node, topic, kind
        self.publisher = session.publish(topic, kind, reliable)
        self.message = find_message(kind)()

    def find_obstacle(self) -> Condition | None:
        """Return why commands would have no effect, or contend with those of others."""
        if self.publisher.get_subscription_count() == 0:
            problem = describe_topic(self._node, self._topic, self._kind, offered=False)
            return Condition("wrong-mode", f"{problem}: activate the controller that takes the commands")
        if self._node.count_publishers(self._topic) > 1:
            ends = self._node.get_publishers_info_by_topic(self._topic)
            who = name_nodes(ends, {self._node.get_name()}) or "another node of the same name"
            return Condition("not-in-control", f"{who} publishes commands to {self._topic} as well: end it")
        return None


class ArrayCommands:
    """Commands as an array of joint values, in the order of the model; implements `Commands` for joints."""

    def __init__(self, facts: ArmInterface, session: Session, turn: FlangeTurn) -> None:
        self._target = Target(session, facts.command, ARRAY, facts.quality.reliable_commands)
        self._mode, self._carries, self.turn_to_flange = facts.mode, facts.carries_weight, turn
        message = self._target.message
        message.data = np.zeros(len(facts.joints)).tolist()
        self._values = np.frombuffer(message.data)

    def begin(self, q: Array) -> None:
        """Do nothing: controllers hold the arm where they were activated."""

    def send(self, kind: CommandKind, command: CommandView) -> str | None:
        """Publish the values of a command."""
        self._values[:] = command.values
        self._target.publisher.publish(self._target.message)
        return None

    def rest(self, q: Array) -> None:
        """Publish the speed 0, or the torque 0 where the driver carries the arm; a position is kept anyway."""
        if self._mode == "velocity" or (self._mode == "torque" and self._carries):
            self._values[:] = 0.0
            self._target.publisher.publish(self._target.message)

    def find_obstacle(self) -> Condition | None:
        """Return why commands would have no effect, or contend with those of others."""
        return self._target.find_obstacle()


class TrajectoryCommands:
    """Commands as a trajectory of one point, which is reached within a period; implements `Commands` for joints."""

    def __init__(self, facts: ArmInterface, session: Session, turn: FlangeTurn) -> None:
        self._target = Target(session, facts.command, TRAJECTORY, facts.quality.reliable_commands)
        self.turn_to_flange = turn
        message, point = self._target.message, find_message("trajectory_msgs/msg/JointTrajectoryPoint")()
        message.joint_names = list(facts.joints)
        point.positions = np.zeros(len(facts.joints)).tolist()
        point.time_from_start.nanosec = int(1e9 / facts.rate_hz)
        message.points = [point]
        self._values = np.frombuffer(point.positions)

    def begin(self, q: Array) -> None:
        """Do nothing: the controller holds the arm."""

    def send(self, kind: CommandKind, command: CommandView) -> str | None:
        """Publish the positions of a command."""
        self._values[:] = command.values
        self._target.publisher.publish(self._target.message)
        return None

    def rest(self, q: Array) -> None:
        """Do nothing: the last position is kept."""

    def find_obstacle(self) -> Condition | None:
        """Return why commands would have no effect, or contend with those of others."""
        return self._target.find_obstacle()


JointCommands: TypeAlias = ArrayCommands | TrajectoryCommands


def make_joint_commands(facts: ArmInterface, session: Session, turn: FlangeTurn) -> JointCommands:
    """Return what the joints of an arm are commanded through."""
    if facts.command_type == TRAJECTORY:
        return TrajectoryCommands(facts, session, turn)
    return ArrayCommands(facts, session, turn)
