"""A button whose state ROS 2 publishes."""

from __future__ import annotations

from typing import Any

from skillc_runtime.backends.ros2.device_facts import DeviceFacts
from skillc_runtime.backends.ros2.receiver import Receiver
from skillc_runtime.devices.sensors import Button


class Ros2Button(Button):
    """One button; its first message is waited for, and later ones may come only when it changes."""

    def __init__(self, facts: DeviceFacts, receiver: Receiver) -> None:
        reliable, topic = facts.quality().reliable_states, facts.topic("switchedTopic")
        self.feed = receiver.feed(topic, "std_msgs/msg/Bool", reliable, self._take)
        self._switched = False

    @property
    def switched(self) -> bool:
        """Whether it is pressed so far that it has switched."""
        return self._switched

    def _take(self, message: Any) -> None:
        self._switched = bool(message.data)
