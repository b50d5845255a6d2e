"""The parameters of the controller that takes the commands of an arm: its joints, in its order, and what it takes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from skillc_runtime.backends.ros2.session import NoAnswer, Session
from skillc_runtime.devices.arm import Mode

ANSWER_S = 0.5
INTERFACES: Final[dict[Mode, str]] = {"position": "position", "velocity": "velocity", "torque": "effort"}
"""The names of ros2_control for what joints are commanded by."""
KIND = "rcl_interfaces/srv/GetParameters"
PARAMETERS = "joints", "interface_name", "command_interfaces"


@dataclass(frozen=True, slots=True)
class ControllerParameters:
    """A controller of ros2_control; `joints` and `interfaces` are empty if it has no such parameters."""

    name: str
    joints: tuple[str, ...]
    interfaces: tuple[str, ...]

    def find_problem(self, joints: Sequence[str], mode: Mode) -> str | None:
        """Return why it is not the one for the commands of a mode to some joints; None if it may be."""
        if self.joints and set(self.joints) != set(joints):
            there, wanted = ", ".join(self.joints), ", ".join(joints)
            return f"{self.name} commands the joints {there}; those of the facts are {wanted} (ros2:jointNames)"
        if self.interfaces and INTERFACES[mode] not in self.interfaces:
            takes = " and ".join(self.interfaces)
            return f"{self.name} takes {takes} commands; the law of the arm gives {mode} commands"
        return None

    def places(self, joints: Sequence[str]) -> list[int]:
        """Return the place of each joint in an array of commands."""
        return [self.joints.index(name) for name in joints] if self.joints else list(range(len(joints)))


def ask_controller(session: Session, topic: str) -> ControllerParameters:
    """Return the parameters of the controller that takes the commands of a topic, which is below its name."""
    name = topic.rpartition("/")[0]
    service = f"{name}/get_parameters"
    if KIND not in dict(session.node.get_service_names_and_types()).get(service, ()):
        return ControllerParameters(name, (), ())
    joints, one, several = (_read(session, service, parameter) for parameter in PARAMETERS)
    return ControllerParameters(name, joints, one + several)


def _read(session: Session, service: str, parameter: str) -> tuple[str, ...]:
    """Return a text or the texts of a parameter; none if the node has no such parameter, or does not answer.

    Each is asked for alone: a node that lacks one of several returns none.
    """
    try:
        values = session.ask(service, KIND, ANSWER_S, names=[parameter]).values
    except NoAnswer:
        return ()
    return tuple(text for each in values for text in (each.string_value, *each.string_array_value) if text)
