"""The topics and services of one cell in ROS 2, below `/skillc/CELL`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import msgspec

from skillc.contract.geometry import CellModel
from skillc.contract.sample import Sample
from skillc.ros.messages import joint_state, markers, wrench
from skillc.ros.orders import CellOrder, OrderAnswer, Word
from skillc_runtime.backends.ros2.session import find_message, plain_name

SERVICES: tuple[Word, ...] = ("start", "pause", "resume", "stop", "acknowledge")
MARKERS_EVERY = 5
"""Every how many samples markers are published: RViz needs no more."""


class CellTopics:
    """What a cell publishes, and what can be asked of it; `order` carries out an order, in the thread of a caller."""

    def __init__(self, node: Any, cell: str, order: Callable[[CellOrder | str], OrderAnswer]) -> None:
        self._node, self._order, self._count = node, order, 0
        self._below = f"/skillc/{plain_name(cell)}/"
        self._publishers: dict[str, Any] = {}
        from rclpy.callback_groups import ReentrantCallbackGroup
        from rclpy.qos import DurabilityPolicy, QoSProfile

        self._latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        group = ReentrantCallbackGroup()  # a pause that takes its time keeps nobody from a stop
        trigger = find_message("std_srvs/srv/Trigger")
        self._services = [
            node.create_service(trigger, self._below + word, self._answering(word), callback_group=group)
            for word in SERVICES
        ]
        self._text = find_message("std_msgs/msg/String")
        self._orders = node.create_subscription(self._text, self._below + "order", self._take, 10, callback_group=group)
        self._answers = node.create_publisher(self._text, self._below + "answer", 10)

    def show(self, sample: Sample, model: CellModel, names: Mapping[str, Sequence[str]]) -> None:
        """Publish what moves; `names` are those of the joints of each arm."""
        stamp = self._node.get_clock().now().to_msg()
        self._publish("joint_states", "sensor_msgs/msg/JointState", joint_state(sample, names, stamp))
        for individual, arm in sample.arms.items():
            if arm.wrench is not None:
                label = individual.rpartition("#")[2]
                topic, message = f"{plain_name(label)}/wrench", wrench(arm, f"{plain_name(label)}_base", stamp)
                self._publish(topic, "geometry_msgs/msg/WrenchStamped", message)
        if self._count % MARKERS_EVERY == 0:
            self._publish("markers", "visualization_msgs/msg/MarkerArray", markers(sample, model, stamp))
        self._count += 1

    def publish_text(self, topic: str, text: bytes) -> None:
        """Publish a JSON text, which late subscribers get as well."""
        self._publish(topic, "std_msgs/msg/String", self._text(data=text.decode()), latched=True)

    def _publish(self, topic: str, kind: str, message: Any, latched: bool = False) -> None:
        if topic not in self._publishers:
            quality = self._latched if latched else 10
            self._publishers[topic] = self._node.create_publisher(find_message(kind), self._below + topic, quality)
        self._publishers[topic].publish(message)

    def _answering(self, word: Word) -> Callable[[Any, Any], Any]:
        def answer(_: Any, response: Any) -> Any:
            found = self._order(CellOrder(word))
            response.success, response.message = found.success, found.message or found.operation
            return response

        return answer

    def _take(self, message: Any) -> None:
        self._answers.publish(self._text(data=msgspec.json.encode(self._order(message.data)).decode()))
