"""Goals of actions of ROS 2: sent one at a time, the newest next; each takes the place of the one before."""

from __future__ import annotations

from typing import Any

from skillc_runtime.backends.control_process.link import Condition
from skillc_runtime.backends.ros2.session import Session, find_message

ABORTED = 6
"""The status of a goal that its server has given up (action_msgs/msg/GoalStatus)."""


class Action:
    """The client of one action. `look` handles what has come; nothing is waited for.

    done: whether the newest goal has ended. aborted: the result of the newest goal, if its server has given it up.
    refused: whether the server has not accepted the newest goal.
    """

    def __init__(self, session: Session, name: str, kind: str) -> None:
        """Use an action of a kind; BackendUnavailable if the package of its messages is not installed."""
        from rclpy.action import ActionClient
        from rclpy.executors import SingleThreadedExecutor

        self.name, self.kind, self._session = name, kind, session
        self.made_of = find_message(kind)
        self._client: Any = ActionClient(session.node, self.made_of, name)
        session.closing.append(self._client.destroy)
        self._executor: Any = SingleThreadedExecutor(context=session.context)
        self._sent: Any = None
        self._handle: Any = None
        self._ends: Any = None
        self.done, self.refused, self.aborted = True, False, None

    @property
    def is_free(self) -> bool:
        """Whether the server has answered the newest goal, so that another one can be sent."""
        return self._sent is None

    def look(self) -> None:
        """Handle the answers that have come."""
        self._executor.add_node(self._session.node)  # A call of a service has taken it.
        self._executor.spin_once(timeout_sec=0.0)
        if self._sent is not None and self._sent.done():
            self._handle, self._sent = self._sent.result(), None
            self.refused = not self._handle.accepted
            self.done = self.refused
            self._ends = None if self.refused else self._handle.get_result_async()
        if self._ends is not None and self._ends.done():
            found, self._ends, self.done = self._ends.result(), None, True
            self.aborted = found.result if found.status == ABORTED else None

    def send(self, goal: Any) -> None:
        """Send a goal; its result is the one that counts from now on."""
        self._sent, self._ends, self.done, self.refused, self.aborted = None, None, False, False, None
        self._sent = self._client.send_goal_async(goal)

    def cancel(self) -> None:
        """Give the newest goal up; nothing happens without one."""
        if self._handle is not None and not self.done:
            self._handle.cancel_goal_async()

    def find_obstacle(self) -> Condition | None:
        """Return why goals would have no effect, or contend with those of others."""
        if not self._client.server_is_ready():
            return Condition(
                "wrong-mode", f"nobody offers the action {self.name} ({self.kind}): activate its controller"
            )
        if self._session.node.count_clients(f"{self.name}/_action/send_goal") > 1:
            return Condition("not-in-control", f"another node sends goals to {self.name} as well: end it")
        return None
