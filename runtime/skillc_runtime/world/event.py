"""What listeners of the world model hear: a write that was made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from skillc_runtime.world.changes import Change
from skillc_runtime.world.evidence import Evidence
from skillc_runtime.world.state import WorldState


@dataclass(frozen=True, slots=True)
class ChangeEvent:
    """A write that was made: the changes, who made them, how they are known, and the versions before and after.

    `known` is None for what others wrote, and for what was taken back.
    """

    changes: tuple[Change, ...]
    origin: str
    before: WorldState
    after: WorldState
    known: Evidence | None = "assumed"


Listener: TypeAlias = Callable[[ChangeEvent], None]
