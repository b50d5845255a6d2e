"""A mobile base that ROS 2 drives: goals as poses, odometry back."""

from __future__ import annotations

import math
from time import monotonic
from typing import Any

import numpy as np

from skillc_runtime.backends.ros2.facts import BaseInterface
from skillc_runtime.backends.ros2.pose_message import read_pose, write_pose
from skillc_runtime.backends.ros2.receiver import Receiver
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.motion.pose import Pose, log

STILL_M_S, STILL_RAD_S, STILL_S = 0.005, 0.01, 0.3
"""A base that has been slower than this for this time is at rest."""
NEAR_RAD = 0.05
LEAVING_S = 5.0
"""How long a base may take to begin to move; one that rests elsewhere after that does not go on by itself."""


class Ros2Base(MobileBase):
    """One base; its odometry is in the frame in which its goals are, which is that of the world."""

    def __init__(self, interface: BaseInterface, at: Pose, near_m: float, receiver: Receiver) -> None:
        """Subscribe to the odometry; `at` is where the base is by the facts, near_m how near to a goal it arrives."""
        self._interface, self._near_m, self._receiver = interface, near_m, receiver
        quality = interface.quality
        self.feed = receiver.feed(interface.odometry, "nav_msgs/msg/Odometry", quality.reliable_states, self._take)
        publish = receiver.session.publish
        self._goals = publish(interface.goal, "geometry_msgs/msg/PoseStamped", quality.reliable_commands)
        self._speeds = publish(interface.velocity, "geometry_msgs/msg/Twist", quality.reliable_commands)
        self._pose = at
        self._goal: Pose | None = at
        self._moved_s = self._commanded_s = -np.inf

    @property
    def pose(self) -> Pose:
        """The pose of the base."""
        with self._receiver.lock:  # wait ends: with the messages that have arrived
            return self._pose

    @property
    def done(self) -> bool:
        """Whether the base has arrived at the last goal."""
        return self._goal is not None and self.at_rest and self._is_near(self._goal)

    @property
    def at_rest(self) -> bool:
        """Whether the base has not moved for a while."""
        return monotonic() - self._moved_s > STILL_S

    @property
    def fault(self) -> str | None:
        """Why the base stopped by itself on the way to the last goal; None if it did not."""
        if (silence := self.feed.find_silence(self._interface.timing)) is not None:
            return silence
        waited = monotonic() - max(self._commanded_s, self._moved_s) > LEAVING_S
        if self._goal is None or not waited or self._is_near(self._goal):
            return None
        away = float(np.linalg.norm((self._goal.position - self.pose.position)[:2]))
        return f"it rests {away:.2f} m from its goal on {self._interface.goal}"

    def drive_to(self, goal: Pose) -> None:
        """Begin to drive to a pose; returns at once."""
        self._goal, self._commanded_s = goal, monotonic()
        self._publish(goal)

    def stop(self) -> None:
        """Brake: a new goal where the base is takes the place of the last one, and the speed 0 that of the present."""
        self._goal = None
        self._publish(self.pose)
        self._speeds.publish(self._speeds.msg_type())

    def _is_near(self, goal: Pose) -> bool:
        here = self.pose
        away = math.dist(here.position[:2], goal.position[:2])
        return away < self._near_m and float(np.linalg.norm(log(here.rotation @ goal.rotation.T))) < NEAR_RAD

    def _publish(self, goal: Pose) -> None:
        message = self._goals.msg_type()
        message.header.frame_id = self._interface.frame
        message.header.stamp = self._receiver.session.node.get_clock().now().to_msg()
        write_pose(goal, message.pose)
        self._goals.publish(message)

    def _take(self, message: Any) -> None:
        speed, turning = message.twist.twist.linear, message.twist.twist.angular
        self._pose = read_pose(message.pose.pose.position, message.pose.pose.orientation)
        if math.hypot(speed.x, speed.y) > STILL_M_S or abs(turning.z) > STILL_RAD_S:
            self._moved_s = monotonic()
