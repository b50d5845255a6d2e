"""The commands that an operation takes."""

from __future__ import annotations

from typing import TypeAlias

from skillc_runtime.recording.commands import (
    Answer,
    Approve,
    Command,
    Pause,
    Replan,
    Resume,
    Retry,
    SetBreakpoints,
    Skip,
    StepInto,
    StepOut,
    StepOver,
    Stop,
)

OperatorCommand: TypeAlias = (
    Approve | Pause | Resume | StepInto | StepOver | StepOut | Retry | Skip | Replan | Answer | SetBreakpoints
)
"""The commands that need the role `operate`; who gives one is its client, whatever it says."""

__all__ = [
    "Answer",
    "Approve",
    "Command",
    "OperatorCommand",
    "Pause",
    "Replan",
    "Resume",
    "Retry",
    "SetBreakpoints",
    "Skip",
    "StepInto",
    "StepOut",
    "StepOver",
    "Stop",
]
