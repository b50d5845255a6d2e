"""What can be requested of a task run, as values that are recorded."""

from __future__ import annotations

from typing import Annotated, TypeAlias

import msgspec

from skillc_runtime.world.state.labels.labelled import LabelledChange

BreakpointText: TypeAlias = Annotated[str, msgspec.Meta(max_length=300)]


class _Command(msgspec.Struct, frozen=True, omit_defaults=True, kw_only=True):
    """A command, and `who` has given it; empty if that is not known."""

    who: str = ""

    @property
    def name(self) -> str:
        """The name of the command, such as `step-over`."""
        return str(self.__struct_config__.tag)


class Approve(_Command, tag="approve", frozen=True):
    """Run the plan that waits for approval."""


class PauseRun(_Command, tag="pause", frozen=True):
    """Pause at the next point where all active skills may be paused."""

    reason: str = "requested"


class Resume(_Command, tag="resume", frozen=True):
    """Continue after a pause."""


class StepInto(_Command, tag="step-into", frozen=True):
    """Continue until the next call starts."""


class StepOver(_Command, tag="step-over", frozen=True):
    """Continue until a call starts that is not part of the current one."""


class StepOut(_Command, tag="step-out", frozen=True):
    """Continue until a call starts that is not part of the call around the current one."""


class Stop(_Command, tag="stop", frozen=True):
    """Halt everything, and end when everything is at rest; `at_once` because the program ends."""

    reason: str = "stopped"
    at_once: bool = False


class Abort(_Command, tag="abort", frozen=True):
    """Halt everything and fail, because devices have stopped by themselves; it is given by the cell, in any state."""

    reason: str


class RetryStep(_Command, tag="retry", frozen=True):
    """After a failure: run the failed step again."""


class Skip(_Command, tag="skip", frozen=True):
    """After a failure: count the failed step as done, because somebody did it; its effects are assumed."""

    why: str


class Replan(_Command, tag="replan", frozen=True):
    """Halt what runs and plan again."""


class AnswerPrompt(_Command, tag="answer", frozen=True):
    """Answer what a skill asks with one of its choices; `prompt` is its number, 0 for the only one."""

    choice: str
    prompt: int = 0


class SetBreakpoints(_Command, tag="set-breakpoints", frozen=True):
    """Pause at these breakpoints from now on, each SKILL or FILE:LINE, and at no others."""

    breakpoints: Annotated[tuple[BreakpointText, ...], msgspec.Meta(max_length=100)]


class EditWorld(_Command, tag="edit-world", frozen=True):
    """Change the world model in one transaction."""

    changes: tuple[LabelledChange, ...]
    why: str


Command: TypeAlias = (
    Approve
    | PauseRun
    | Resume
    | StepInto
    | StepOver
    | StepOut
    | Stop
    | Abort
    | RetryStep
    | Skip
    | Replan
    | AnswerPrompt
    | SetBreakpoints
    | EditWorld
)
