"""Inspects surfaces by what a node of the user publishes: the share of each that is clean."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from time import monotonic
from typing import Any

from skillc_runtime.backends.ros2.facts import CleanShareTopic
from skillc_runtime.backends.ros2.receiver import Receiver, TopicFeed
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.devices.sensors import Camera

SHARE = "std_msgs/msg/Float64"


class Ros2Inspection(Camera):
    """The topics of surfaces by IRI, each with shares from 0 to 1."""

    def __init__(self, topics: Mapping[str, CleanShareTopic], receiver: Receiver) -> None:
        self._topics = topics
        self._shares: dict[str, float] = {}
        self._feeds: dict[str, TopicFeed] = {
            surface: receiver.feed(each.topic, SHARE, False, partial(self._take, surface))
            for surface, each in topics.items()
        }

    def inspect(self, surface: str) -> float:
        """Return the share of a surface, by IRI, that is clean; NoSuchDevice without a recent message."""
        if surface not in self._topics:
            raise NoSuchDevice("no topic has the share of the surface that is clean: state ros2:cleanShareTopic")
        topic, seen_s = self._topics[surface], self._feeds[surface].seen_s
        if seen_s is None or monotonic() - seen_s > topic.fresh_s:
            raise NoSuchDevice(f"{topic.topic} has been silent for {topic.fresh_s:g} s (skillc:stateTimeout)")
        return self._shares[surface]

    def rubbed_share(self, surface: str, seconds: float) -> float:
        """Raise NoSuchDevice: no topic has that."""
        raise NoSuchDevice("no topic of ROS 2 has how long the places of a surface were rubbed")

    def _take(self, surface: str, message: Any) -> None:
        self._shares[surface] = min(max(float(message.data), 0.0), 1.0)
