"""Publishes what a Cartesian controller on the robot's side shall do: target pose, stiffness and wrench."""

from __future__ import annotations

from time import monotonic
from typing import Any, Final

import numpy as np

from skillc_runtime.backends.control_process.link import CommandKind, CommandView, DeviceCondition
from skillc_runtime.backends.ros2.arms.arm_commands import ArmCommands, CommandTopic
from skillc_runtime.backends.ros2.arms.flange import FlangeModel
from skillc_runtime.backends.ros2.arms.joint_commands import make_joint_commands
from skillc_runtime.backends.ros2.facts import ArmInterface, ToolTopics
from skillc_runtime.backends.ros2.pose_message import write_pose
from skillc_runtime.backends.ros2.session import Session, find_message
from skillc_runtime.motion.arrays import OutVector
from skillc_runtime.motion.pose import Array, Pose, rotation_from_quaternion

NAMES: Final = tuple(f"stiffness.{kind}_{axis}" for kind in ("trans", "rot") for axis in "xyz")
NEW_SHARE: Final = 0.01
"""A stiffness that differs by less than this share of its greatest part is not sent again."""
ANSWER_S: Final = 0.5
"""An answer that has not come by then is not waited for any more."""
KIND: Final = "rcl_interfaces/srv/SetParameters"

OBLIQUE = 0.05
"""A stiffness may have this share of its greatest part off the axes in which the controller takes it."""

POSE, WRENCH = "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/WrenchStamped"


class ToolCommands:
    """Implements `ArmCommands` for an arm whose own law holds the tool.

    A motion of the joints is commanded to `joints`, the topic of joint commands; where there is none, to the pose that
    the flange has in that posture.
    """

    def __init__(
        self, facts: ArmInterface, tool: ToolTopics, joints: ArmCommands | None, flange: FlangeModel, session: Session
    ) -> None:
        reliable = facts.quality.reliable_commands
        self._tool, self._joints, self._flange = tool, joints, flange
        self._pose = CommandTopic(session, tool.pose, POSE, reliable)
        self._stiffness: CommandTopic | StiffnessParameters | None = None
        if tool.stiffness_node:
            self._stiffness = StiffnessParameters(session, tool.stiffness_node)
        elif tool.stiffness:
            self._stiffness = CommandTopic(session, tool.stiffness, WRENCH, reliable)
        self._wrench = CommandTopic(session, tool.wrench, WRENCH, reliable) if tool.wrench else None
        self._pose.message.header.frame_id = tool.frame
        for target in (self._stiffness, self._wrench):
            if isinstance(target, CommandTopic):
                target.message.header.frame_id = tool.flange if tool.along_flange else tool.frame
        self._on_flange: Pose | None = None

    def fit(self) -> str | None:
        """Ask the controller of the joints, if there is one; return why it is not the right one, or None."""
        return None if self._joints is None else self._joints.fit()

    def begin(self, q: Array) -> None:
        """Push with nothing, and hold the flange where it is, with the joints at q (nv,) in rad."""
        self._send_six(self._wrench, np.zeros(6))
        self._send_posture(q)

    def send(self, kind: CommandKind, command: CommandView) -> str | None:
        """Publish a command; return why the controller cannot yield like that, or None."""
        self._on_flange = in_flange = Pose.of(command.on_flange[:3], command.on_flange[3:])
        if kind != "tool":
            self._send_six(self._wrench, np.zeros(6))
            if self._joints is not None:
                return self._joints.send(kind, command)
            self._send_posture(command.values)
            return None
        tool = Pose.of(command.pose[:3], command.pose[3:])
        flange = tool @ in_flange.inverse()
        self._send_pose(flange if self._tool.of_flange else tool)
        axes = self._message_axes(flange).T @ rotation_from_quaternion(command.axes)
        stiffness = [axes @ np.diag(part) @ axes.T for part in (command.stiffness[:3], command.stiffness[3:])]
        force, moment = axes @ command.push[:3], axes @ command.push[3:]
        if self._tool.of_flange:
            lever = self._message_axes(flange).T @ (tool.position - flange.position)
            moment = moment + np.cross(lever, force)
        diagonals = np.concatenate([np.diag(each) for each in stiffness])
        if isinstance(self._stiffness, StiffnessParameters):
            self._stiffness.send(diagonals)
        else:
            self._send_six(self._stiffness, diagonals)
        self._send_six(self._wrench, np.concatenate([force, moment]))
        if any(np.abs(each - np.diag(np.diag(each))).max() > OBLIQUE * each.max() for each in stiffness):
            axes_of = self._tool.flange if self._tool.along_flange else self._tool.frame
            return f"{self._tool.pose} takes a stiffness along the axes of {axes_of}, not across them"
        return None

    def rest(self, q: Array) -> None:
        """Push with nothing, and hold the flange where it is, with the joints at q (nv,) in rad."""
        self.begin(q)

    def find_obstacle(self) -> DeviceCondition | None:
        """Return why commands would have no effect, or contend with those of others."""
        targets = [each for each in (self._pose, self._stiffness, self._wrench, self._joints) if each is not None]
        return next((found for each in targets if (found := each.find_obstacle()) is not None), None)

    def _message_axes(self, flange: Pose) -> Array:
        """Return the axes (3, 3), in base, along which stiffness and wrench are published."""
        return flange.rotation if self._tool.along_flange else np.eye(3)

    def _send_posture(self, q: Array) -> None:
        """Publish the pose that the flange has with the joints at q (nv,) in rad."""
        flange = self._flange.find(q)
        if self._tool.of_flange:
            self._send_pose(flange)
        elif self._on_flange is not None:
            self._send_pose(flange @ self._on_flange)

    def _send_pose(self, pose: Pose) -> None:
        write_pose(pose, self._pose.message.pose)
        self._pose.publisher.publish(self._pose.message)

    def _send_six(self, target: CommandTopic | None, six: OutVector) -> None:
        if target is None:
            return
        part: Any = target.message.wrench
        part.force.x, part.force.y, part.force.z, part.torque.x, part.torque.y, part.torque.z = six.tolist()
        target.publisher.publish(target.message)


def make_commands(facts: ArmInterface, model: str, session: Session) -> ArmCommands:
    """Return what an arm is commanded through; `model` is the file of its model."""
    joints = make_joint_commands(facts, session) if facts.command else None
    if facts.tool is not None:
        return ToolCommands(facts, facts.tool, joints, FlangeModel(model), session)
    assert joints is not None, "an arm without a Cartesian controller has a topic for its joints"
    return joints


class StiffnessParameters:
    """Sets them without waiting: one request at a time, the newest values next."""

    def __init__(self, session: Session, node: str) -> None:
        """Use the service by which the parameters of a node are set."""
        self._service = f"{node}/set_parameters"
        self._kind = find_message(KIND)
        self._client: Any = session.node.create_client(self._kind, self._service)
        self._waits_until, self._refusal = 0.0, ""
        self._sent = np.full(len(NAMES), np.nan)
        request, parameter = self._kind.Request(), find_message("rcl_interfaces/msg/Parameter")
        request.parameters = [parameter(name=name) for name in NAMES]
        for each in request.parameters:
            each.value.type = 3  # a double
        self._request = request

    def send(self, stiffness: Array) -> None:
        """Set a stiffness (6,) in N/m and N m/rad, unless it is set already or an answer is waited for."""
        self._take_answer()
        is_new = not np.abs(stiffness - self._sent).max() <= NEW_SHARE * stiffness.max()
        if self._waits_until > monotonic() or not is_new or not self._client.service_is_ready():
            return
        for each, value in zip(self._request.parameters, stiffness.tolist(), strict=True):
            each.value.double_value = value
        self._client.handle.send_request(self._request)
        self._waits_until, self._sent = monotonic() + ANSWER_S, stiffness.copy()

    def find_obstacle(self) -> DeviceCondition | None:
        """Return why the stiffness cannot be set; None if it can."""
        self._take_answer()
        if not self._client.service_is_ready():
            return DeviceCondition(
                "wrong-mode", f"nobody offers the service {self._service} ({KIND}): activate the controller"
            )
        return DeviceCondition("wrong-mode", f"{self._service} refuses: {self._refusal}") if self._refusal else None

    def _take_answer(self) -> None:
        found = self._client.handle.take_response(self._kind.Response)
        if found is None or found[0] is None:
            return
        self._waits_until = 0.0
        refused = [each.reason or "no reason is given" for each in found[1].results if not each.successful]
        self._refusal = refused[0] if refused else ""
