"""What the process of the tree asks of a control process: small calls only, which fit between two cycles.

Poses, directions and motions are in the axes of the arm's base. What takes long, such as checking a motion, is computed
by the process of the tree before.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Final, Literal, TypeAlias

from skillc_runtime.backends.control_process.message_socket import MessageSocket

Part: TypeAlias = Literal["driver", "motion", "compliance", "device"]
"""What is called: the driver of the arm, one of its parts, or the loop itself."""

OFFERED: Final[Mapping[Part, frozenset[str]]] = MappingProxyType(
    {
        "driver": frozenset({"take_fault", "abort", "hold_still", "secure", "set_speed"}),
        "motion": frozenset(
            {
                "stopping_pose", "joints_ahead", "follow_tool", "follow_joints", "stop", "pause", "resume",
                "add_checked_overlay", "remove_overlay", "tracking_error_message", "hold_position",
            }
        ),
        "compliance": frozenset(
            {
                "release", "restore", "release_rotation", "restore_rotation", "yields_along", "push", "push_off",
                "start_push", "end_push", "push_force", "pause", "withdraw", "resume",
            }
        ),
        "device": frozenset(
            {"explain", "condition", "recover", "give_back", "take_control", "set_load", "tare"}
        ),
    }
)  # fmt: skip
"""The names of the calls; all else is refused."""

CALLS_A_CYCLE_SHARE = 0.2
"""Share of a period after whose end, counted from its begin, no further call is taken in the same cycle."""


@dataclass(frozen=True, slots=True)
class RemoteCall:
    """A call with a number, by which its answer is known."""

    number: int
    part: Part
    name: str
    arguments: tuple[Any, ...] = ()


@dataclass(frozen=True, slots=True)
class RemoteAnswer:
    """What a call has returned, or the error that it has raised."""

    number: int
    value: Any = None
    error: Exception | None = None


class Mailbox:
    """The end of a socket from which a control process takes calls, one at a time; `closed` if nobody calls."""

    def __init__(self, messages: MessageSocket) -> None:
        self._socket, self.closed = messages, False

    def take(self) -> RemoteCall | None:
        """Return the next call; None if none waits. Nothing is waited for."""
        if self.closed:
            return None
        try:
            call = self._socket.take()
        except (EOFError, OSError):
            self.close()
            return None
        return call if isinstance(call, RemoteCall) else None

    def answer(self, answer: RemoteAnswer) -> None:
        """Send an answer."""
        try:
            self._socket.send(answer)
        except OSError:
            self.close()

    def close(self) -> None:
        """Take no further call."""
        self.closed = True
