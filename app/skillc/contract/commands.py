"""The commands that an operation takes."""

from __future__ import annotations

from typing import TypeAlias

from skillc_runtime.recording.commands import (
    AnswerPrompt,
    Approve,
    Command,
    PauseRun,
    Replan,
    Resume,
    RetryStep,
    SetBreakpoints,
    Skip,
    StepInto,
    StepOut,
    StepOver,
    Stop,
)

OperatorCommand: TypeAlias = (
    Approve
    | PauseRun
    | Resume
    | StepInto
    | StepOver
    | StepOut
    | RetryStep
    | Skip
    | Replan
    | AnswerPrompt
    | SetBreakpoints
)
"""The commands that need the role `operate`; who gives one is its client, whatever it says."""

__all__ = [
    "AnswerPrompt",
    "Approve",
    "Command",
    "OperatorCommand",
    "PauseRun",
    "Replan",
    "Resume",
    "RetryStep",
    "SetBreakpoints",
    "Skip",
    "StepInto",
    "StepOut",
    "StepOver",
    "Stop",
]
