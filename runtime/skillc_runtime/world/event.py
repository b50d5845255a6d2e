"""What listeners of the world model hear: a write that was made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from skillc_runtime.world.changes import Change
from skillc_runtime.world.state import WorldState


@dataclass(frozen=True, slots=True)
class ChangeEvent:
    """A write that was made: the changes, who made them, and the versions before and after."""

    changes: tuple[Change, ...]
    origin: str
    before: WorldState
    after: WorldState


Listener: TypeAlias = Callable[[ChangeEvent], None]
