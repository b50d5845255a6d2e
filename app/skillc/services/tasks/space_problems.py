"""What looking at a task in space finds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import msgspec

from skillc_model.skills import SkillLibrary, Task

if TYPE_CHECKING:
    from skillc_runtime.scene.load import LoadedScene


class SpaceProblem(msgspec.Struct, frozen=True):
    """A step that does not go in space, and why.

    `call` is the place of its call among those in the body of the task; None if it was planned. `certain` if nothing
    that is known would do without it, and nothing before it could not be looked at. `cure` is a place of a thing with
    which all goes, as a sentence; empty if none was found. If it goes where the scene has all things, `displaced` says
    from where on it does not, of the places where a thing may really be; else it is empty.
    """

    step: str
    why: str
    certain: bool
    call: int | None = None
    cure: str = ""
    displaced: str = ""


@dataclass(frozen=True, slots=True)
class OutOfTime:
    """A look that was given up after so many seconds, so that nothing is known."""

    after_s: float


SpaceJudge: TypeAlias = "Callable[[SkillLibrary, LoadedScene, Task], SpaceProblem | OutOfTime | None]"
"""Returns the step of a task that does not go in its scene; None if nothing is known against any."""
