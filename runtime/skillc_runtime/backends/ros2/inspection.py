"""Inspects surfaces by what a node of the user publishes: the share of each that is clean."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from time import monotonic
from typing import Any

from skillc_runtime.backends.ros2.receiver import Feed, Receiver
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.devices.sensors import Camera

FRESH_S = 5.0
"""An older share is that of an earlier state of the surface."""


class Ros2Inspection(Camera):
    """The topics of surfaces by IRI, each with shares from 0 to 1 (std_msgs/msg/Float64)."""

    def __init__(self, topics: Mapping[str, str], receiver: Receiver) -> None:
        self._shares: dict[str, float] = {}
        self._feeds: dict[str, Feed] = {
            surface: receiver.feed(topic, "std_msgs/msg/Float64", False, partial(self._take, surface))
            for surface, topic in topics.items()
        }

    def inspect(self, surface: str) -> float:
        """Return the share of a surface, by IRI, that is clean; KeyError if nobody has told it lately."""
        feed = self._feeds.get(surface)
        if feed is None:
            raise NoSuchDevice("no topic tells how clean the surface is (ros2:cleanShareTopic)")
        if feed.seen_s is None or monotonic() - feed.seen_s > FRESH_S:
            raise NoSuchDevice(f"{feed.subscription.topic} has not told for {FRESH_S:g} s how clean the surface is")
        return self._shares[surface]

    def rubbed_share(self, surface: str, seconds: float) -> float:
        """Raise KeyError: no topic tells how long a place was rubbed."""
        raise NoSuchDevice("no topic tells how long the places of a surface were rubbed")

    def _take(self, surface: str, message: Any) -> None:
        self._shares[surface] = min(max(float(message.data), 0.0), 1.0)
