"""The postures of an arm's data sheet, for skills."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


def posture_of(state: WorldState, arm: str, name: str) -> Array:
    """Return the joint values (nv,) in rad of the posture called `name`; SkillFailure lists those that there are."""
    try:
        return sheet_of(state, arm).posture(name)
    except SheetError as error:
        raise SkillFailure(str(error)) from error
