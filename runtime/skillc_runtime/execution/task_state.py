"""The states of a task run, and which requests each allows."""

from __future__ import annotations

import msgspec

from skillc_runtime.recording.commands import Abort, Command
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.states import EndState, State

ALLOWED: dict[State, tuple[str, ...]] = {
    "queued": ("stop", "set-breakpoints", "edit-world"),
    "planning": ("stop", "set-breakpoints", "edit-world"),
    "planned": ("approve", "replan", "stop", "set-breakpoints", "edit-world"),
    "running": ("pause", "stop", "set-breakpoints", "edit-world"),
    "pausing": ("resume", "stop", "set-breakpoints", "edit-world"),
    "paused": ("resume", "step-into", "step-over", "step-out", "replan", "stop", "set-breakpoints", "edit-world"),
    "stopping": ("stop", "edit-world"),
    "succeeded": (),
    "failed": (),
    "stopped": (),
    "interrupted": (),
}
"""The names of the commands that each state allows."""

ALLOWED_AFTER_FAILURE = ("retry", "skip", "replan", "stop", "set-breakpoints", "edit-world")
"""The same for a run that is paused because a step failed."""

ANSWER = "answer"
"""The name of the command that a run allows besides, while its skills ask operators."""

TRANSITIONS: dict[State, frozenset[State]] = {
    "queued": frozenset({"planning", "planned", "running", "stopping", "stopped", "failed"}),
    "planning": frozenset({"queued", "planned", "running", "pausing", "stopping", "stopped", "failed"}),
    "planned": frozenset({"queued", "planning", "running", "stopping", "stopped", "failed"}),
    "running": frozenset({"planning", "pausing", "paused", "stopping", "succeeded", "failed"}),
    "pausing": frozenset({"planning", "paused", "running", "stopping", "succeeded", "failed"}),
    "paused": frozenset({"queued", "planning", "running", "pausing", "stopping", "stopped", "failed"}),
    "stopping": frozenset({"stopped", "failed"}),
    "succeeded": frozenset(),
    "failed": frozenset(),
    "stopped": frozenset(),
    "interrupted": frozenset(),
}
"""The states that can follow each state; from each that is no end, `interrupted` as well."""


class Ending(msgspec.Struct, frozen=True):
    """How a run that is stopping will end."""

    state: EndState
    failure: Failure


class RefusedCommand(msgspec.Struct, frozen=True):
    """A request that a task run does not allow now, or `why` it cannot be done; nothing has changed."""

    command: str
    state: State
    allowed: tuple[str, ...]
    why: str = ""

    def __str__(self) -> str:
        if self.why:
            return f"`{self.command}` is refused: {self.why}"
        allowed = f"it allows {', '.join(self.allowed)}" if self.allowed else "it has ended"
        return f"`{self.command}` is not possible while the task is {self.state}; {allowed}"


def refusal(command: Command, state: State, allowed: tuple[str, ...]) -> RefusedCommand | None:
    """Return why a command is not allowed; None if it is."""
    fits = isinstance(command, Abort) or command.name in allowed
    return None if fits else RefusedCommand(command.name, state, allowed)
