"""The postures of an arm's data sheet."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.primitive import SkillFailure

if TYPE_CHECKING:
    from skillc_runtime.world.state import WorldState

CORE = "https://w3id.org/skillc/core#"
HAS_SHEET, HAS_POSTURE = CORE + "hasSheet", CORE + "hasPosture"
POSTURE_NAME, JOINT_VALUES = CORE + "postureName", CORE + "jointValues"


def posture_of(state: WorldState, arm: str, name: str) -> Array:
    """Return the joint values (nv,) in rad of the posture called `name`; SkillFailure lists those that there are."""
    found: dict[str, str] = {}
    for sheet in state.objects(arm, HAS_SHEET):
        for posture in state.objects(sheet, HAS_POSTURE):
            found[str(state.value(posture, POSTURE_NAME))] = str(state.value(posture, JOINT_VALUES))
    if name not in found:
        known = ", ".join(sorted(found)) or "none"
        raise SkillFailure(f"the arm's data sheet knows no posture {name!r}; it knows: {known}")
    return np.array([float(value) for value in found[name].split()])
