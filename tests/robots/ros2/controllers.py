"""What a simulated robot offers for its arms, grippers and bases: controllers that take commands, and broadcasters."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import numpy as np
from geometry_msgs.msg import PoseStamped, Twist, WrenchStamped
from nav_msgs.msg import Odometry
from std_msgs.msg import Float64MultiArray
from trajectory_msgs.msg import JointTrajectory

from robots.ros2.cartesian import CartesianImpedance
from robots.ros2.describing import describe
from skillc_runtime.devices.arm import Command, JointPosition, JointVelocity, Torque
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation

if TYPE_CHECKING:
    from robots.ros2.peer import Peer

FASTEST_M_S = 1.5
"""A target of the tool that moves faster is a jump."""


class Arm:
    """The controllers of one arm, and its broadcasters."""

    def __init__(self, individual: str, peer: Peer) -> None:
        self._arm, self._peer = peer.cell.arms[individual], peer
        facts = next(each for each in peer.cell.scene.arms if each.individual == individual)
        prefix = peer.cell.scene.names[individual] + "/"
        model = peer.cell.model
        names = [
            model.joint(j).name.removeprefix(prefix)
            for j in range(model.njnt)
            if model.joint(j).name.startswith(prefix)
        ]
        self.names = [peer.options.joint_names.get(each, each) for each in names]
        self._flange = model.site(prefix + "flange").id
        self._limits, self._last, self._last_at = self._arm.limits, None, 0.0
        self._law = CartesianImpedance(len(names)) if peer.options.control == "cartesian" else None
        control, has_sensor = peer.options.control, facts.force_torque
        self._arm.switch(
            {"velocity": "velocity", "position": "position", "trajectory": "position"}.get(control, self._arm.interface)
        )  # type: ignore[arg-type]
        self._goal: tuple[Any, Any, float, float] | None = None
        topics = {
            "position": ("forward_position_controller/commands", Float64MultiArray, self._take),
            "velocity": ("forward_velocity_controller/commands", Float64MultiArray, self._take),
            "effort": ("forward_effort_controller/commands", Float64MultiArray, self._take),
            "trajectory": ("joint_trajectory_controller/joint_trajectory", JointTrajectory, self._take_trajectory),
        }
        if control in topics:
            peer.subscribe(*topics[control])
        if peer.options.described:
            peer.describe(describe(model, prefix, peer.options.joint_names))
        if peer.options.shuffled:
            peer.add_controller("forward_position_controller", self.names[::-1], "position")
        if self._law is not None:
            peer.subscribe("cartesian_controller/joint_trajectory", JointTrajectory, self._take_posture)
            peer.subscribe("cartesian_controller/reference_pose", PoseStamped, self._take_pose)
            peer.subscribe("cartesian_controller/set_cartesian_stiffness", WrenchStamped, self._law.take_stiffness)
            peer.subscribe("cartesian_controller/set_cartesian_wrench", WrenchStamped, self._law.take_wrench)
        self._wrench = peer.publisher("force_torque_sensor_broadcaster/wrench", WrenchStamped) if has_sensor else None

    def command(self, now: float) -> Command | None:
        """Return what the active controller commands; the last command counts until there is another one."""
        if self._law is not None:
            state = self._arm.state()
            return Torque(self._law.torques(state, self._find_flange()))
        if self._goal is not None:
            start, goal, begin, span = self._goal
            share = min(1.0, (now - begin) / span)
            return JointPosition(start + share * (goal - start))
        if self._last is None or self._peer.options.control == "trajectory":
            return None
        kind = {"position": JointPosition, "velocity": JointVelocity, "effort": Torque}[self._peer.options.control]  # type: ignore[index]
        return kind(self._last)

    def publish(self) -> tuple[list[str], list[float], list[float], list[float]]:
        """Publish the wrench; return names, positions, speeds and efforts of the joints."""
        state = self._arm.state()
        if self._wrench is not None:
            self._publish_wrench(state)
        return self.names, state.q.tolist(), state.dq.tolist(), state.effort.tolist()

    def _find_flange(self) -> Pose:
        """Return the flange in the base."""
        data = self._peer.cell.data
        return self._arm.base.inverse() @ Pose(data.site_xpos[self._flange], data.site_xmat[self._flange].reshape(3, 3))

    def _publish_wrench(self, state: Any) -> None:
        """Publish the wrench of the environment at the flange, along its axes."""
        flange = self._find_flange()
        force, moment = state.wrench[:3], state.wrench[3:]
        moment = moment + np.cross(state.tool.position - flange.position, force)
        message = WrenchStamped()
        message.header.frame_id, message.header.stamp = "tool0", self._peer.stamp()
        for part, values in ((message.wrench.force, force), (message.wrench.torque, moment)):
            part.x, part.y, part.z = (flange.rotation.T @ values).tolist()
        self._peer.send(self._wrench, message)

    def _take(self, message: Float64MultiArray) -> None:
        values = np.array(message.data)[:: -1 if self._peer.options.shuffled else 1]
        self._check(values)
        self._last = values

    def _take_pose(self, message: PoseStamped) -> None:
        """Take a target, and complain about one that jumps."""
        assert self._law is not None
        report, now, place = self._peer.report, time.monotonic(), read_pose(message.pose).position
        report.commands += 1
        before = self._law.target
        span = now - self._last_at + self._peer.options.jitter_s + 0.02
        if before is not None and np.linalg.norm(place - before.position) > FASTEST_M_S * span:
            report.complain(f"a target {np.linalg.norm(place - before.position):.3f} m away within {span:.4f} s")
        self._last_at = now
        self._law.take_pose(message)

    def _take_posture(self, message: JointTrajectory) -> None:
        order = [list(message.joint_names).index(each) for each in self.names]
        q = np.array(message.points[-1].positions)[order]
        assert self._law is not None
        self._law.take_posture(q, self._arm.flange_at(q))

    def _take_trajectory(self, message: JointTrajectory) -> None:
        point = message.points[-1]
        order = [list(message.joint_names).index(each) for each in self.names]
        goal, span = np.array(point.positions)[order], point.time_from_start.sec + 1e-9 * point.time_from_start.nanosec
        now = self._peer.cell.now
        self._check(goal)
        command = self.command(now)
        start = command.q if isinstance(command, JointPosition) else self._arm.state().q.copy()
        self._goal = start, goal, now, max(span, 1e-3)

    def _check(self, values: Any) -> None:
        """Complain about what no driver may command."""
        report, limits, control = self._peer.report, self._limits, self._peer.options.control
        report.commands += 1
        if values.size != len(self.names) or not np.isfinite(values).all():
            report.complain(f"a command with {values.size} values, or one that is no number: {values}")
        elif control == "effort" and (np.abs(values) > limits.effort + 1e-6).any():
            report.complain(f"torques {values}")
        elif control == "velocity" and (np.abs(values) > limits.velocity + 1e-6).any():
            report.complain(f"speeds {values}")
        elif control in ("position", "trajectory"):
            if (values < limits.range[:, 0] - 1e-6).any() or (values > limits.range[:, 1] + 1e-6).any():
                report.complain(f"positions {values}")
            now, before = time.monotonic(), self._last
            if before is None:
                before, self._last_at = self._arm.state().q.copy(), now - 0.02
            step = np.abs(values - before)
            # Messages that arrive late come closer together than they were sent.
            span = max(now - self._last_at, 1.0 / self._peer.options.rate_hz) + self._peer.options.jitter_s + 0.01
            if (step > limits.velocity * span + 1e-6).any():
                report.complain(f"a step of {step.max():.4f} rad within {span:.4f} s")
            self._last, self._last_at = values, now


class Hand:
    """A gripper by the position of its first finger; contact of both fingers is a grasp."""

    def __init__(self, individual: str, peer: Peer) -> None:
        self._gripper, self._peer = peer.cell.gripper(individual), peer
        prefix, model = peer.cell.scene.names[individual] + "/", peer.cell.model
        names = [
            model.joint(j).name.removeprefix(prefix)
            for j in range(model.njnt)
            if model.joint(j).name.startswith(prefix)
        ]
        self._names, self._force_n = names, self._gripper.max_force_n
        peer.subscribe("gripper_controller/commands", Float64MultiArray, self._take)
        peer.subscribe("gripper_controller/max_effort", Float64MultiArray, self._take_force)
        peer.serve("open_gripper", lambda: self._move(self._gripper.max_opening_m))
        peer.serve("close_gripper", lambda: self._move(0.0))

    def publish(self) -> tuple[list[str], list[float], list[float], list[float]]:
        """Grasp what the fingers touch from both sides; return names, positions, speeds and efforts of the fingers."""
        gripper, cell = self._gripper, self._peer.cell
        if gripper.blocked and gripper.holding is None:
            for thing in cell.scene.graspable:
                if gripper.touches(thing.individual):
                    gripper.attach(thing.individual, Pose(np.zeros(3), np.eye(3)), 0.0)
        half, number = gripper.opening_m / 2, len(self._names)
        moving = 0.01 if gripper.moving else 0.0
        return self._names, [half] * number, [moving] * number, [0.0] * number

    @property
    def holds(self) -> str:
        """What it holds, by its short name."""
        return self._peer.cell.scene.names.get(self._gripper.carries or "", "")

    def _take(self, message: Float64MultiArray) -> None:
        self._move(2 * message.data[0])

    def _take_force(self, message: Float64MultiArray) -> None:
        self._force_n = message.data[0]

    def _move(self, opening_m: float) -> None:
        if opening_m > self._gripper.opening_m:
            self._gripper.detach()
        self._gripper.move(opening_m, self._force_n)


class Base:
    """A mobile base that drives to goals and publishes its odometry."""

    def __init__(self, individual: str, peer: Peer) -> None:
        self._base, self._peer, self._pose = peer.cell.base(individual), peer, None
        peer.subscribe("goal_pose", PoseStamped, self._take_goal)
        peer.subscribe("cmd_vel", Twist, self._take_speed)
        self._odometry = peer.publisher("odom", Odometry)

    def publish(self) -> None:
        """Publish the odometry."""
        message, pose = Odometry(), self._base.pose
        message.header.frame_id, message.header.stamp = "map", self._peer.stamp()
        fill_pose(message.pose.pose, pose)
        message.twist.twist.linear.x = 0.0 if self._base.at_rest else 0.1
        self._peer.send(self._odometry, message)

    def _take_goal(self, message: PoseStamped) -> None:
        self._base.drive_to(read_pose(message.pose))

    def _take_speed(self, message: Twist) -> None:
        if message.linear.x == 0.0 and message.angular.z == 0.0:
            self._base.stop()


def fill_pose(message: Any, pose: Pose) -> None:
    """Write a pose to a message; quaternions of ROS have w last."""
    message.position.x, message.position.y, message.position.z = pose.position.tolist()
    w, x, y, z = quaternion_from_rotation(pose.rotation).tolist()
    message.orientation.w, message.orientation.x, message.orientation.y, message.orientation.z = w, x, y, z


def read_pose(message: Any) -> Pose:
    """Return the pose of a message."""
    at, turn = message.position, message.orientation
    return Pose.of((at.x, at.y, at.z), (turn.w, turn.x, turn.y, turn.z))
