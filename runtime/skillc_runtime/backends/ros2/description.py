"""The robot as ROS describes it: a topic with its URDF, which most drivers offer."""

from __future__ import annotations

from skillc_runtime.backends.ros2.described_robot import find_difference
from skillc_runtime.backends.ros2.facts import ArmInterface
from skillc_runtime.backends.ros2.session import Session
from skillc_runtime.motion.pose import Array

ARRIVES_S = 1.0


class Description:
    """The newest message of the topic."""

    def __init__(self, session: Session, facts: ArmInterface) -> None:
        """Subscribe to it."""
        self._session, self._facts, self._urdf = session, facts, ""
        self._topic = session.subscribe(facts.description, "std_msgs/msg/String", True, latched=True)

    def find_difference(self, model: str, q: Array) -> str | None:
        """Return how it differs from the model of a file, with the joints at q (n,) in rad.

        None if it does not, or if nobody publishes it.
        """
        topic = self._facts.description
        if not self._session.node.count_publishers(topic) or not self._session.wait_until(self._take, ARRIVES_S):
            return None
        difference = find_difference(self._urdf, self._facts.joints, model, q)
        return None if difference is None else f"by {topic}, {difference} (ros2:jointNames)"

    def _take(self) -> bool:
        """Take what has come; return whether anything has."""
        while (message := self._topic.take()) is not None:
            self._urdf = message.data
        return bool(self._urdf)
