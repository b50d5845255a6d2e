"""What an arm is commanded through, whichever its controller: the interface, and the topics that take commands."""

from __future__ import annotations

from typing import Protocol

from skillc_runtime.backends.control_process.link import CommandKind, CommandView, DeviceCondition
from skillc_runtime.backends.ros2.session import Session, describe_topic, find_message, name_nodes
from skillc_runtime.motion.pose import Array


class ArmCommands(Protocol):
    """What an arm is commanded through."""

    def fit(self) -> str | None:
        """Ask the controller what it takes; return why these commands are not for it, or None."""
        ...

    def begin(self, q: Array) -> None:
        """Prepare for commands, with the joints at q (nv,) in rad."""
        ...

    def send(self, kind: CommandKind, command: CommandView) -> str | None:
        """Publish a command; return why it cannot be expressed, or None."""
        ...

    def rest(self, q: Array) -> None:
        """Let the arm stand still, with the joints at q (nv,) in rad."""
        ...

    def find_obstacle(self) -> DeviceCondition | None:
        """Return why commands would have no effect, or contend with those of others."""
        ...


class CommandTopic:
    """A topic that takes commands, and who else is there."""

    def __init__(self, session: Session, topic: str, kind: str, reliable: bool) -> None:
        self._node, self._topic, self._kind = session.node, topic, kind
        self.publisher = session.publish(topic, kind, reliable)
        self.message = find_message(kind)()

    def find_obstacle(self) -> DeviceCondition | None:
        """Return why commands would have no effect, or contend with those of others."""
        if self.publisher.get_subscription_count() == 0:
            problem = describe_topic(self._node, self._topic, self._kind, offered=False)
            return DeviceCondition("wrong-mode", f"{problem}: activate the controller that takes the commands")
        if self._node.count_publishers(self._topic) > 1:
            ends = self._node.get_publishers_info_by_topic(self._topic)
            who = name_nodes(ends, {self._node.get_name()}) or "another node of the same name"
            return DeviceCondition("not-in-control", f"{who} publishes commands to {self._topic} as well: end it")
        return None
