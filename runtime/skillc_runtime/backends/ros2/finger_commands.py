"""Sends a gripper where its fingers shall be: by topics, by an action, or by services that open and close it."""

from __future__ import annotations

from math import inf
from threading import Lock
from time import monotonic
from typing import Any, Protocol

from skillc_runtime.backends.ros2.facts import ARRAY, GRIP, GripperInterface
from skillc_runtime.backends.ros2.goal_client import GoalClient
from skillc_runtime.backends.ros2.session import Session, find_message, find_refusal, no_answer, no_service

SERVICE_S = 5.0
"""How long a service may take to answer."""


class FingerCommands(Protocol):
    """What a gripper is moved by."""

    def aim(self, opening_m: float, now_m: float, widest_m: float) -> float:
        """Return the opening in m that a command for `opening_m` leads to, from `now_m`."""
        ...

    def send(self, opening_m: float, force_n: float) -> None:
        """Let the fingers go to an opening in m with at most a force in N; returns at once."""
        ...

    def repeat(self) -> None:
        """Send the last command again, as messages may be lost; called while the fingers have not begun to move."""
        ...

    def stop(self, opening_m: float) -> None:
        """Let the fingers rest at the opening in m that they have."""
        ...

    def look(self) -> str | None:
        """Handle what was answered; return why the last command has failed, or None. Called again and again."""
        ...

    def forget(self) -> None:
        """Forget why the last command has failed: somebody has acknowledged that."""
        ...


class FingerTopics:
    """Moves them by the position of the first joint, with a topic for the greatest force if there is one."""

    def __init__(self, facts: GripperInterface, session: Session) -> None:
        reliable = facts.quality.reliable_commands
        self._facts, self._last = facts, (0.0, 0.0)
        self._command = session.publish(facts.command, ARRAY, reliable)
        self._effort = session.publish(facts.effort, ARRAY, reliable) if facts.effort else None

    def aim(self, opening_m: float, now_m: float, widest_m: float) -> float:
        """Return the opening itself."""
        return opening_m

    def send(self, opening_m: float, force_n: float) -> None:
        """Publish force and position."""
        self._last = opening_m, force_n
        if self._effort is not None:
            self._publish(self._effort, [force_n])
        self._publish(self._command, [self._facts.position(opening_m)] * len(self._facts.joints))

    def repeat(self) -> None:
        """Publish them again."""
        self.send(*self._last)

    def stop(self, opening_m: float) -> None:
        """Publish the opening that there is."""
        self.send(opening_m, self._last[1])

    def look(self) -> str | None:
        """Return None: nothing is answered."""
        return None

    def forget(self) -> None:
        """Do nothing."""

    @staticmethod
    def _publish(publisher: Any, values: list[float]) -> None:
        publisher.publish(publisher.msg_type(data=values))


class FingerAction:
    """Moves them by goals of an action, which is reliable."""

    def __init__(self, facts: GripperInterface, session: Session) -> None:
        self._facts, self._action = facts, GoalClient(session, facts.command, facts.command_type)

    def aim(self, opening_m: float, now_m: float, widest_m: float) -> float:
        """Return the opening itself."""
        return opening_m

    def send(self, opening_m: float, force_n: float) -> None:
        """Send a goal."""
        goal, position = self._action.made_of.Goal(), self._facts.position(opening_m)
        if self._action.kind == GRIP:
            goal.command.position, goal.command.max_effort = position, force_n
        else:
            count = len(self._facts.joints)
            goal.command.name, goal.command.position = list(self._facts.joints), [position] * count
            goal.command.effort = [force_n] * count
        self._action.send(goal)

    def repeat(self) -> None:
        """Do nothing."""

    def stop(self, opening_m: float) -> None:
        """Give the goal up."""
        self._action.cancel()

    def look(self) -> str | None:
        """Return that the server has refused the goal, or has given it up without a thing between the fingers."""
        action = self._action
        action.look()
        if action.refused:
            return f"{action.name} has refused a goal"
        if action.aborted is not None and action.aborted[1] and not action.aborted[0].stalled:
            return f"{action.name} has given up a goal"
        return None

    def forget(self) -> None:
        """Forget the answer of the server."""
        self._action.forget()


class FingerServices:
    """Opens and closes them. The clients are there from the start: a service that does not know a client cannot answer.

    A command is sent as soon as its service is there; `look` takes the answer.
    """

    def __init__(self, facts: GripperInterface, session: Session) -> None:
        self._session, self._opens = session, False
        kind = find_message("std_srvs/srv/Trigger")
        self._opening: Any = session.node.create_client(kind, facts.open_service)
        self._closing: Any = session.node.create_client(kind, facts.close_service)
        self._called: Any = None
        self._answer: Any = None
        self._late_s, self._lock = inf, Lock()
        self._fault: str | None = None

    def aim(self, opening_m: float, now_m: float, widest_m: float) -> float:
        """Return the widest opening, or 0."""
        self._opens = opening_m > now_m
        return widest_m if self._opens else 0.0

    def send(self, opening_m: float, force_n: float) -> None:
        """Call the service; returns at once."""
        with self._lock:  # wait ends: with the answers that have come
            self._called = self._opening if self._opens else self._closing
            self._answer, self._fault, self._late_s = None, None, monotonic() + SERVICE_S

    def repeat(self) -> None:
        """Do nothing."""

    def stop(self, opening_m: float) -> None:
        """Do nothing: there is no service for that."""

    def look(self) -> str | None:
        """Return why the last service has not succeeded."""
        with self._lock:  # wait ends: with the answers that have come
            if self._called is not None:
                self._take_answer(self._called)
            return self._fault

    def forget(self) -> None:
        """Forget why the last service has not succeeded."""
        self._fault = None

    def _take_answer(self, called: Any) -> None:
        if self._answer is None and called.service_is_ready():
            self._answer = called.call_async(called.srv_type.Request())
        self._session.take_answers()
        if self._answer is not None and self._answer.done():
            self._called, self._fault = None, find_refusal(called.service_name, self._answer.result())
        elif monotonic() > self._late_s:
            why = no_service(called.service_name) if self._answer is None else no_answer(called.service_name, SERVICE_S)
            self._called, self._fault = None, why


def make_finger_commands(facts: GripperInterface, session: Session) -> FingerCommands:
    """Return what a gripper is moved by."""
    if facts.open_service:
        return FingerServices(facts, session)
    return FingerTopics(facts, session) if facts.command_type == ARRAY else FingerAction(facts, session)
