"""Receives messages for the devices of a cell that need no real time: one node, in a thread of its own."""

from __future__ import annotations

from collections.abc import Callable
from threading import Event, Lock, Thread
from time import monotonic
from typing import Any

from skillc_runtime.backends.ros2.device_facts import Timing
from skillc_runtime.backends.ros2.session import Session, Subscription, describe_topic
from skillc_runtime.devices.backend import BackendUnavailable

WAIT_S = 0.05
CLOSE_S = 2.0


class TopicFeed:
    """The messages of one topic, as a device takes them; `seen_s` is when the last one came, by the wall clock."""

    def __init__(self, subscription: Subscription, take: Callable[[Any], None]) -> None:
        self.subscription, self.take = subscription, take
        self.seen_s: float | None = None

    def take_all(self) -> None:
        """Let the device take the messages that have arrived."""
        while (message := self.subscription.take()) is not None:
            self.take(message)
            self.seen_s = monotonic()

    def find_silence(self, timing: Timing) -> str | None:
        """Return why the device that publishes it counts as lost; None if it does not."""
        silent = monotonic() - (self.seen_s or 0.0)
        return f"{self.subscription.topic} has been silent for {silent:.1f} s" if silent > timing.silence_s else None


class Receiver:
    """A node whose thread takes messages; devices are called with `lock` held, and hold it where they read."""

    def __init__(self, name: str) -> None:
        """Open the node; BackendUnavailable if there is no ROS 2."""
        self.session, self.lock = Session(name), Lock()
        self._feeds: list[TopicFeed] = []
        self._closing = Event()
        self._thread = Thread(target=self._run, name=name, daemon=True)

    @property
    def is_needed(self) -> bool:
        """Whether a device takes messages."""
        return bool(self._feeds)

    def feed(
        self, topic: str, kind: str, reliable: bool, take: Callable[[Any], None], *, latched: bool = False
    ) -> TopicFeed:
        """Let a device take the messages of a topic; before `begin`."""
        found = TopicFeed(self.session.subscribe(topic, kind, reliable, latched), take)
        self._feeds.append(found)
        return found

    def begin(self) -> None:
        """Begin to take messages."""
        self._thread.start()

    def await_first(self, feed: TopicFeed, timing: Timing, who: str) -> None:
        """Wait for the first message of a topic; BackendUnavailable, with what is on the graph instead."""
        end = monotonic() + timing.connect_s
        while feed.seen_s is None:
            if monotonic() > end:
                topic = feed.subscription
                why = describe_topic(self.session.node, topic.topic, topic.kind, offered=True)
                raise BackendUnavailable(f"{who} does not answer: {why}")
            self._closing.wait(WAIT_S)

    def close(self) -> None:
        """End the thread and the node."""
        self._closing.set()
        if self._thread.is_alive():
            self._thread.join(CLOSE_S)
        self.session.close()

    def _run(self) -> None:
        while not self._closing.is_set():
            self.session.wait(WAIT_S)
            with self.lock:  # wait ends: with what a device copies of a message
                for feed in self._feeds:
                    feed.take_all()
