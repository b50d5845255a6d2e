"""Sends the commands of one arm's joints: arrays, or trajectories of one point each by a topic or an action."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from time import monotonic
from typing import Final

import numpy as np

from skillc_runtime.backends.control_process.link import CommandKind, CommandView, DeviceCondition
from skillc_runtime.backends.ros2.arms.arm_commands import ArmCommands, CommandTopic
from skillc_runtime.backends.ros2.facts import ARRAY, FOLLOW, TRAJECTORY, ArmInterface
from skillc_runtime.backends.ros2.goal_client import GoalClient
from skillc_runtime.backends.ros2.session import NoAnswer, Session, find_message
from skillc_runtime.devices.arm import Mode
from skillc_runtime.motion.pose import Array

ANSWER_S = 0.5
INTERFACES: Final[dict[Mode, str]] = {"position": "position", "velocity": "velocity", "torque": "effort"}
"""The names of ros2_control for what joints are commanded by."""
KIND = "rcl_interfaces/srv/GetParameters"
PARAMETERS = "joints", "interface_name", "command_interfaces"

SLOWEST_S = 0.2
"""The longest time that a goal of an action may take to be reached."""


class ArrayCommands:
    """Commands as an array of joint values; implements `ArmCommands` for joints.

    They are in the order of the model, unless the controller has another one by its parameters.
    """

    def __init__(self, facts: ArmInterface, session: Session) -> None:
        self._target = CommandTopic(session, facts.command, ARRAY, facts.quality.reliable_commands)
        self._facts, self._session = facts, session
        self._places = list(range(len(facts.joints)))
        message = self._target.message
        message.data = np.zeros(len(facts.joints)).tolist()
        self._values = np.frombuffer(message.data)

    def fit(self) -> str | None:
        """Ask the controller what it takes, and take over its order; return why it is not the right one, or None."""
        facts, controller = self._facts, ask_controller(self._session, self._facts.command)
        if (problem := controller.find_problem(facts.joints, facts.mode)) is not None:
            return problem
        self._places = controller.places(facts.joints)
        return None

    def begin(self, q: Array) -> None:
        """Do nothing: controllers hold the arm where they were activated."""

    def send(self, kind: CommandKind, command: CommandView) -> str | None:
        """Publish the values of a command."""
        self._values[self._places] = command.values
        self._target.publisher.publish(self._target.message)
        return None

    def rest(self, q: Array) -> None:
        """Publish the speed 0, or the torque 0 where the driver carries the arm; a position is kept anyway."""
        if self._facts.mode == "velocity" or (self._facts.mode == "torque" and self._facts.carries_weight):
            self._values[:] = 0.0
            self._target.publisher.publish(self._target.message)

    def find_obstacle(self) -> DeviceCondition | None:
        """Return why commands would have no effect, or contend with those of others."""
        return self._target.find_obstacle()


class TrajectoryCommands:
    """Commands as a trajectory of one point, which is reached within a period; implements `ArmCommands` for joints."""

    def __init__(self, facts: ArmInterface, session: Session) -> None:
        self._target = CommandTopic(session, facts.command, TRAJECTORY, facts.quality.reliable_commands)
        self._facts, self._session = facts, session
        message, point = self._target.message, find_message("trajectory_msgs/msg/JointTrajectoryPoint")()
        message.joint_names = list(facts.joints)
        point.positions = np.zeros(len(facts.joints)).tolist()
        point.time_from_start.nanosec = int(1e9 / facts.rate_hz)
        message.points = [point]
        self._values = np.frombuffer(point.positions)

    def fit(self) -> str | None:
        """Ask the controller what it takes; return why it is not the right one, or None: messages name the joints."""
        controller = ask_controller(self._session, self._facts.command)
        return controller.find_problem(self._facts.joints, self._facts.mode)

    def begin(self, q: Array) -> None:
        """Do nothing: the controller holds the arm."""

    def send(self, kind: CommandKind, command: CommandView) -> str | None:
        """Publish the positions of a command."""
        self._values[:] = command.values
        self._target.publisher.publish(self._target.message)
        return None

    def rest(self, q: Array) -> None:
        """Do nothing: the last position is kept."""

    def find_obstacle(self) -> DeviceCondition | None:
        """Return why commands would have no effect, or contend with those of others."""
        return self._target.find_obstacle()


class ActionCommands:
    """Commands as goals of one point each, as fast as the server accepts them; implements `ArmCommands` for joints."""

    def __init__(self, facts: ArmInterface, session: Session) -> None:
        self._action, self._facts = GoalClient(session, facts.command, FOLLOW), facts
        self._session = session
        self._goal, point = self._action.made_of.Goal(), find_message("trajectory_msgs/msg/JointTrajectoryPoint")()
        self._goal.trajectory.joint_names = list(facts.joints)
        self._goal.trajectory.points = [point]
        self._sent_s = -inf

    def fit(self) -> str | None:
        """Ask the controller what it takes; return why it is not the right one, or None: goals name the joints."""
        controller = ask_controller(self._session, self._facts.command)
        return controller.find_problem(self._facts.joints, self._facts.mode)

    def begin(self, q: Array) -> None:
        """Forget how the last goal has ended: the controller holds the arm."""
        self._action.forget()

    def send(self, kind: CommandKind, command: CommandView) -> str | None:
        """Send the positions, to be reached by when the next goal will come; return why the last one has failed."""
        action = self._action
        action.look()
        if action.refused or action.aborted is not None:
            why = "" if action.aborted is None else action.aborted[0].error_string
            return f"{action.name} has {'refused' if action.refused else 'given up'} a goal{why and ': '}{why}"
        if action.is_free:
            now, period_s = monotonic(), 1.0 / self._facts.rate_hz
            point = self._goal.trajectory.points[0]
            point.positions = command.values.tolist()
            point.time_from_start.nanosec = int(1e9 * min(max(now - self._sent_s, period_s), SLOWEST_S))
            action.send(self._goal)
            self._sent_s = now
        return None

    def rest(self, q: Array) -> None:
        """Give the last goal up: the controller stops the arm."""
        self._action.cancel()

    def find_obstacle(self) -> DeviceCondition | None:
        """Return why goals would have no effect, or contend with those of others."""
        return self._action.find_obstacle()


def make_joint_commands(facts: ArmInterface, session: Session) -> ArmCommands:
    """Return what the joints of an arm are commanded through."""
    if facts.command_type == TRAJECTORY:
        return TrajectoryCommands(facts, session)
    if facts.command_type == FOLLOW:
        return ActionCommands(facts, session)
    return ArrayCommands(facts, session)


@dataclass(frozen=True, slots=True)
class ControllerParameters:
    """A controller of ros2_control; `joints` and `interfaces` are empty if it has no such parameters."""

    name: str
    joints: tuple[str, ...]
    interfaces: tuple[str, ...]

    def find_problem(self, joints: Sequence[str], mode: Mode) -> str | None:
        """Return why it is not the one for the commands of a mode to some joints; None if it may be."""
        if self.joints and set(self.joints) != set(joints):
            there, wanted = ", ".join(self.joints), ", ".join(joints)
            return f"{self.name} commands the joints {there}; those of the facts are {wanted} (ros2:jointNames)"
        if self.interfaces and INTERFACES[mode] not in self.interfaces:
            takes = " and ".join(self.interfaces)
            return f"{self.name} takes {takes} commands; the law of the arm gives {mode} commands"
        return None

    def places(self, joints: Sequence[str]) -> list[int]:
        """Return the place of each joint in an array of commands."""
        return [self.joints.index(name) for name in joints] if self.joints else list(range(len(joints)))


def ask_controller(session: Session, topic: str) -> ControllerParameters:
    """Return the parameters of the controller that takes the commands of a topic, which is below its name."""
    name = topic.rpartition("/")[0]
    service = f"{name}/get_parameters"
    if KIND not in dict(session.node.get_service_names_and_types()).get(service, ()):
        return ControllerParameters(name, (), ())
    joints, one, several = (_read(session, service, parameter) for parameter in PARAMETERS)
    return ControllerParameters(name, joints, one + several)


def _read(session: Session, service: str, parameter: str) -> tuple[str, ...]:
    """Return a text or the texts of a parameter; none if the node has no such parameter, or does not answer.

    Each is asked for alone: a node that lacks one of several returns none.
    """
    try:
        values = session.ask(service, KIND, ANSWER_S, names=[parameter]).values
    except NoAnswer:
        return ()
    return tuple(text for each in values for text in (each.string_value, *each.string_array_value) if text)
