"""Exceptions of skill code as text for people."""

from __future__ import annotations

import traceback
from pathlib import PurePath

from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.robots.watchdog import Silence
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.transactions import StoreError


def told(error: BaseException) -> str:
    """Return what an exception says; one that was not meant for people with its type and the line that raised it."""
    if isinstance(error, SkillFailure | Silence | EvaluationError | WorldError | StoreError):
        return str(error)
    frames = traceback.extract_tb(error.__traceback__)
    where = f" ({PurePath(frames[-1].filename).name}:{frames[-1].lineno})" if frames else ""
    return f"{type(error).__name__}: {error}{where}"
