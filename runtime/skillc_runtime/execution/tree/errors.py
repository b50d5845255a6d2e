"""Messages and failures for exceptions raised by skill code."""

from __future__ import annotations

import traceback
from pathlib import PurePath

from skillc_dsl.position import Position
from skillc_runtime.devices.backend import BackendBroken
from skillc_runtime.devices.cell import WatchdogTimeout
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.recording.failure import Failure
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.python_calls import EvaluationError, ForeignError
from skillc_runtime.world.state.transactions import StoreError

FOR_USERS = (SkillFailure, BackendBroken, WatchdogTimeout, NoSuchDevice, EvaluationError, WorldError, StoreError)
"""Exceptions whose messages are sentences."""


def describe_exception(error: BaseException) -> str:
    """Return the message of an exception, with type and line unless the message is meant for users."""
    if isinstance(error, FOR_USERS):
        return str(error)
    error = error.__cause__ if isinstance(error, ForeignError) and error.__cause__ is not None else error
    frames = traceback.extract_tb(error.__traceback__)
    where = f" ({PurePath(frames[-1].filename).name}:{frames[-1].lineno})" if frames else ""
    return f"{type(error).__name__}: {error}{where}"


def make_error(error: BaseException, source: Position, skill: str = "") -> Failure:
    """Return the failure of a node, or of a call of a skill, because of an exception."""
    return Failure(kind="error", message=describe_exception(error), source=source, skill=skill)
