"""A node of ROS 2 for one device: messages are taken by a wait set, without an executor, so a loop allocates little."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Collection, Sequence
from time import monotonic
from typing import Any

from skillc_runtime.devices.backend import BackendUnavailable

RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
"""The variable of the environment by which ROS 2 finds nodes on this machine only, or on others too."""
WITHOUT = (
    "there is no ROS 2 here: source the set-up file of an installed ROS 2 in this terminal, with the Python that it "
    "was built for, or install its wheels with pip install 'skillc[ros2]' (Linux on x86-64)"
)
DISCOVERY_S, DEPTH = 0.05, 10
ANSWERS = 3
"""How many answers are handled at a time."""
UNKNOWN = {"_NODE_NAME_UNKNOWN_": "another node"}


class NoAnswer(Exception):
    """A service has not answered; the message says which, and why."""


class Session:
    """One node, with its own context."""

    def __init__(self, name: str) -> None:
        """Open a node; BackendUnavailable if there is no ROS 2.

        Nodes on other machines are only found if the environment says so.
        """
        os.environ.setdefault(RANGE, "LOCALHOST")
        try:
            import rclpy
            from rclpy.context import Context
            from rclpy.impl.implementation_singleton import rclpy_implementation
            from rclpy.node import Node
            from rclpy.signals import SignalHandlerOptions
        except ImportError as error:
            raise BackendUnavailable(f"{WITHOUT} ({error})") from error
        self.context = Context()
        rclpy.init(context=self.context, signal_handler_options=SignalHandlerOptions.NO)
        self.node: Any = Node(
            name, context=self.context, enable_rosout=False, start_parameter_services=False, use_global_arguments=False
        )
        self._make_wait_set = rclpy_implementation.WaitSet
        self._subscriptions: list[Subscription] = []
        self.closing: list[Callable[[], None]] = []
        """What is destroyed before the node, which does not know it."""
        self._wait_set: Any = None
        self._executor: Any = None

    def subscribe(self, topic: str, kind: str, reliable: bool, latched: bool = False) -> Subscription:
        """Subscribe to a topic with messages of a kind such as `sensor_msgs/msg/JointState`."""
        found = Subscription(self.node, topic, kind, _quality(reliable, latched))
        self._subscriptions.append(found)
        self._wait_set = None
        return found

    def publish(self, topic: str, kind: str, reliable: bool) -> Any:
        """Return a publisher of a topic."""
        return self.node.create_publisher(find_message(kind), topic, _quality(reliable, False, depth=1))

    def wait(self, seconds: float) -> None:
        """Wait until one of the subscriptions has a message, or so long."""
        if self._wait_set is None:
            self._wait_set = self._make_wait_set(len(self._subscriptions), 0, 0, 0, 0, 0, self.context.handle)
        wait_set = self._wait_set
        wait_set.clear_entities()
        for each in self._subscriptions:
            wait_set.add_subscription(each.handle)
        wait_set.wait(max(int(seconds * 1e9), 0))

    def take_answers(self) -> None:
        """Handle what services and actions have answered; nothing is waited for."""
        from rclpy.executors import SingleThreadedExecutor

        if self._executor is None:
            self._executor = SingleThreadedExecutor(context=self.context)
        self._executor.add_node(self.node)  # A call of a service has taken it.
        for _ in range(ANSWERS):
            self._executor.spin_once(timeout_sec=0.0)

    def call(self, service: str, seconds: float) -> str | None:
        """Call a service of std_srvs/srv/Trigger; return why it has not succeeded, or None."""
        try:
            answer = self.ask(service, "std_srvs/srv/Trigger", seconds)
        except NoAnswer as error:
            return str(error)
        return find_refusal(service, answer)

    def ask(self, service: str, kind: str, seconds: float, **request: Any) -> Any:
        """Return what a service of a kind answers to a request; NoAnswer."""
        from rclpy.executors import SingleThreadedExecutor

        client = self.node.create_client(find_message(kind), service)
        try:
            end = monotonic() + seconds
            if not client.wait_for_service(seconds):
                raise NoAnswer(no_service(service))
            future = client.call_async(client.srv_type.Request(**request))
            executor = SingleThreadedExecutor(context=self.context)
            try:
                executor.add_node(self.node)
                executor.spin_until_future_complete(future, max(end - monotonic(), 0.01))
            finally:
                executor.remove_node(self.node)
                executor.shutdown(0.0)
            if not future.done():
                raise NoAnswer(no_answer(service, seconds))
            return future.result()
        finally:
            self.node.destroy_client(client)

    def wait_until(self, ready: Callable[[], bool], seconds: float) -> bool:
        """Wait until something holds, for so long at most; return whether it does."""
        end = monotonic() + seconds
        while not ready():
            if monotonic() > end:
                return False
            self.wait(DISCOVERY_S)
        return True

    def close(self) -> None:
        """Destroy the node; idempotent."""
        if self.context.ok():
            for destroy in self.closing:
                destroy()
            self.node.destroy_node()
            self.context.try_shutdown()


class Subscription:
    """The messages of one topic, to be taken; those that an executor takes while a service is called are kept."""

    def __init__(self, node: Any, topic: str, kind: str, quality: Any) -> None:
        self.topic, self.kind, self._type = topic, kind, find_message(kind)
        self._kept: deque[Any] = deque(maxlen=DEPTH)
        self._subscription = node.create_subscription(self._type, topic, self._keep, quality)
        self.handle = self._subscription.handle

    def take(self) -> Any:
        """Return the oldest message that has not been taken; None if there is none."""
        if self._kept:
            return self._kept.popleft()
        found = self.handle.take_message(self._type, False)
        return None if found is None else found[0]

    def _keep(self, message: object) -> None:
        self._kept.append(message)


def find_message(kind: str) -> Any:
    """Return the class of a message or a service; BackendUnavailable if its package is not installed."""
    from importlib import import_module

    package, folder, name = kind.split("/")
    try:
        return getattr(import_module(f"{package}.{folder}"), name)
    except (ImportError, AttributeError) as error:
        raise BackendUnavailable(f"the ROS 2 here has no {kind} ({error}): install its package {package}") from error


def find_refusal(service: str, answer: Any) -> str | None:
    """Return why a service of std_srvs/srv/Trigger has not succeeded, by its answer; None if it has."""
    return None if answer.success else (answer.message or f"the service {service} has refused")


def no_service(service: str) -> str:
    """Return that a service is not there."""
    return f"nobody offers the service {service}"


def no_answer(service: str, seconds: float) -> str:
    """Return that a service is too slow."""
    return f"the service {service} has not answered within {seconds:g} s"


def plain_name(text: str) -> str:
    """Return a part of the name of a node or a topic for any text."""
    name = "".join(c if c.isascii() and c.isalnum() else "_" for c in text)
    return name if name[:1].isalpha() else f"_{name}"


def describe_topic(node: Any, topic: str, kind: str, offered: bool) -> str:
    """Return in words why no messages come from a topic, or arrive there; `offered`: others publish it."""
    there = dict(node.get_topic_names_and_types()).get(topic, [])
    ends: Sequence[Any] = (
        node.get_publishers_info_by_topic(topic) if offered else node.get_subscriptions_info_by_topic(topic)
    )
    if others := sorted({each.topic_type for each in ends} - {kind}):
        return f"{topic} has messages of {', '.join(others)}, not of {kind}"
    if not ends:
        who = "publishes" if offered else "subscribes to"
        known = sorted(name for name, kinds in node.get_topic_names_and_types() if kind in kinds and name != topic)
        beside = f"; there are {', '.join(known)}" if known else ""
        return f"nobody {who} {topic} ({kind}){beside}" if there or known else f"nobody {who} {topic} ({kind})"
    return f"no message of {topic} has arrived, which {name_nodes(ends)} publishes" if offered else ""


def name_nodes(ends: Sequence[Any], without: Collection[str] = ()) -> str:
    """Return the names of the nodes of publishers or subscribers; one that has just come has none yet."""
    names = {each.node_name for each in ends} - set(without)
    return ", ".join(sorted(UNKNOWN.get(name, name) for name in names))


def _quality(reliable: bool, latched: bool, depth: int = DEPTH) -> Any:
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    return QoSProfile(
        depth=depth,
        reliability=ReliabilityPolicy.RELIABLE if reliable or latched else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )
