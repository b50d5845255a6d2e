"""The events of runs and what they consist of, for programs that listen to them."""

from skillc_runtime.devices.prompts import Prompt
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import (
    Disturbed,
    Event,
    ImplementationChosen,
    NodeEnded,
    NodeStarted,
    Note,
    Paused,
    PlanArrived,
    PlanMade,
    PromptsChanged,
    Replanned,
    Requested,
    Resumed,
    StateChanged,
    TaskEnded,
    TaskStarted,
    WorldChanged,
)
from skillc_runtime.recording.failure import Failure, Rejection
from skillc_runtime.recording.history.account import CallOutput, MeasuredProperty

__all__ = [
    "CallOutput",
    "Disturbed",
    "Envelope",
    "Event",
    "Failure",
    "ImplementationChosen",
    "MeasuredProperty",
    "NodeEnded",
    "NodeStarted",
    "Note",
    "Paused",
    "PlanArrived",
    "PlanMade",
    "Prompt",
    "PromptsChanged",
    "Rejection",
    "Replanned",
    "Requested",
    "Resumed",
    "StateChanged",
    "TaskEnded",
    "TaskStarted",
    "WorldChanged",
]
