"""The client of an action of ROS 2: sends one goal at a time; each takes the place of the one before."""

from __future__ import annotations

from functools import partial
from typing import Any

from skillc_runtime.backends.control_process.link import DeviceCondition
from skillc_runtime.backends.ros2.session import Session, find_message

ABORTED = 6
"""The status of a goal that its server has given up (action_msgs/msg/GoalStatus)."""


class GoalClient:
    """The client of one action. `look` handles what has come; nothing is waited for.

    refused: whether the server has not accepted the newest goal. aborted: the result of the last goal that it has given
    up, and whether that was the newest one; None for none. Goals whose place was taken count as given up by nobody.
    """

    def __init__(self, session: Session, name: str, kind: str) -> None:
        """Use an action of a kind; BackendUnavailable if the package of its messages is not installed."""
        from rclpy.action import ActionClient

        self.name, self.kind, self._session = name, kind, session
        self.made_of = find_message(kind)
        self._client: Any = ActionClient(session.node, self.made_of, name)
        session.closing.append(self._client.destroy)
        self._sent: Any = None
        self._handle: Any = None
        self._number = 0
        self.refused = False
        self.aborted: tuple[Any, bool] | None = None

    @property
    def is_free(self) -> bool:
        """Whether the server has answered the newest goal, so that another one can be sent."""
        return self._sent is None

    def look(self) -> None:
        """Handle the answers that have come."""
        self._session.take_answers()
        if self._sent is not None and self._sent.done():
            self._handle, self._sent = self._sent.result(), None
            self.refused = not self._handle.accepted
            if self._handle.accepted:
                self._handle.get_result_async().add_done_callback(partial(self._end, self._number))

    def send(self, goal: Any) -> None:
        """Send a goal, which takes the place of the one before."""
        self._number += 1
        self.forget()
        self._sent = self._client.send_goal_async(goal)

    def forget(self) -> None:
        """Forget how the newest goal has ended."""
        self.refused, self.aborted = False, None

    def cancel(self) -> None:
        """Give the newest goal up; nothing happens without one, or if it has ended."""
        if self._handle is not None and self._handle.accepted:
            self._handle.cancel_goal_async()

    def find_obstacle(self) -> DeviceCondition | None:
        """Return why goals would have no effect, or contend with those of others."""
        if not self._client.server_is_ready():
            return DeviceCondition(
                "wrong-mode", f"nobody offers the action {self.name} ({self.kind}): activate its controller"
            )
        if self._session.node.count_clients(f"{self.name}/_action/send_goal") > 1:
            return DeviceCondition("not-in-control", f"another node sends goals to {self.name} as well: end it")
        return None

    def _end(self, number: int, future: Any) -> None:
        found = future.result()
        if found is not None and found.status == ABORTED:
            self.aborted = found.result, number == self._number
