"""Tells by facts whether something stands elsewhere than before, or is held by another."""

from __future__ import annotations

import numpy as np

from skillc_model.read_write import FactPattern
from skillc_runtime.motion.pose import log
from skillc_runtime.planning.world_changes import find_changed_facts
from skillc_runtime.world.space.frames import find_pose
from skillc_runtime.world.state.terms import (
    ANCHOR,
    ANGLES,
    AT,
    BASE_FRAME_ID,
    BOARD,
    CONTAIN,
    FACE,
    IS_TAKEN,
    OFFSET,
    ON,
    OPENING,
    ORIENTATION,
    POSITION,
    RESERVED_FOR,
)
from skillc_runtime.world.state.world_state import WorldState

MOVED_M, TURNED_RAD = 0.01, 0.02
"""By how much something has to stand elsewhere so that a way may be there that was missing, in m and rad.

Where something was is sensed again with less than that.
"""

WHERE = frozenset((*POSITION, *ORIENTATION, *ANGLES, *OFFSET, BASE_FRAME_ID, ANCHOR, FACE, BOARD, OPENING, ON))
"""The terms of facts from which the pose of a thing follows."""


def stands_elsewhere(fact: FactPattern, before: WorldState, after: WorldState) -> bool:
    """Whether something stands elsewhere, or is held by another, by a fact in which versions of the world differ.

    A place that is taken counts as well.
    """
    if fact.term in (AT, CONTAIN, IS_TAKEN):
        return True
    if fact.term not in WHERE or fact.subject is None or _is_reserved(fact.subject, before, after):
        return False
    one, other = find_pose(before, fact.subject), find_pose(after, fact.subject)
    if one is None or other is None:
        return one is not other
    between = log(other.rotation @ one.rotation.T)
    return bool(np.linalg.norm(other.position - one.position) > MOVED_M or np.linalg.norm(between) > TURNED_RAD)


def _is_reserved(individual: str, *states: WorldState) -> bool:
    """Whether something is only a place that is kept for a thing."""
    return any(RESERVED_FOR in each.facts and each.objects(individual, RESERVED_FOR) for each in states)


def has_moved(before: WorldState, after: WorldState) -> bool:
    """Whether anything stands elsewhere, or is held by another, in a version of the world than in an earlier one."""
    return any(stands_elsewhere(each, before, after) for each in find_changed_facts(before, after))
