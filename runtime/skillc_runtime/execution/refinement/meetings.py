"""Which steps of a plan may not run at the same time: their arms would come into one place."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress
from functools import cached_property
from itertools import combinations, product

import numpy as np

from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import check_current
from skillc_runtime.collision.swept_space import CUBE_M, SweptSpace, join_spaces
from skillc_runtime.execution.refinement.situation import RefinedMotion
from skillc_runtime.motion.pose import Array
from skillc_runtime.planning.arrangement import find_predecessors
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.planning.validation import PlanError
from skillc_runtime.recording.space_claim import StepsApart
from skillc_runtime.world.state.world_state import WorldState


def find_steps_apart(
    library: SkillLibrary, state: WorldState, steps: Sequence[Step], motions: Sequence[Sequence[RefinedMotion]]
) -> tuple[StepsApart, ...]:
    """Return which steps have to run one after the other although facts let them overlap; `motions` are those of each.

    An arm sweeps its places at the begin and at the end of its motions, too. So whatever two steps do that neither wait
    for each other nor are named here, each arm may stand anywhere on its way meanwhile.
    """
    if len({each.arm for one in motions for each in one}) < 2:
        return ()
    spaces, short = [_group_by_arm(each) for each in motions], state.vocabulary.short
    before = [set(each) for each in _find_predecessors(library, state, steps)]
    found = list[StepsApart]()
    for late in range(len(steps)):
        before[late] |= {first for each in before[late] for first in before[each]}
        for early in reversed(range(late)):
            check_current()
            if early not in before[late] and (arms := _find_meeting(spaces[early], spaces[late])) is not None:
                one, other = arms
                found.append(StepsApart(early + 1, late + 1, (short(one), short(other))))
                before[late] |= {early, *before[early]}
    return tuple(found)


def find_meeting_arms(groups: Iterable[Sequence[RefinedMotion]]) -> tuple[str, str] | None:
    """Return two arms that come into one place in motions of different groups, which run at the same time."""
    moving = [each for each in groups if each]
    if len({each.arm for one in moving for each in one}) < 2:
        return None
    spaces = [_group_by_arm(each) for each in moving]
    return next((arms for pair in combinations(spaces, 2) if (arms := _find_meeting(*pair)) is not None), None)


def _find_predecessors(library: SkillLibrary, state: WorldState, steps: Sequence[Step]) -> Iterable[frozenset[int]]:
    """Return which steps wait for which, by the facts; none does in a plan that does not work."""
    with suppress(PlanError):
        return find_predecessors(Plan(tuple(steps), 0.0), library, state)
    return [frozenset()] * len(steps)


class _Way:
    """The motions of one arm; the space that they sweep is computed if another arm may come there."""

    def __init__(self, motions: Sequence[RefinedMotion]) -> None:
        self._motions = motions

    @cached_property
    def _space(self) -> SweptSpace:
        return join_spaces([each.sweep() for each in self._motions])

    @cached_property
    def _bases(self) -> list[tuple[Array, float]]:
        return [(each.base.position, each.reach_m) for each in self._motions]

    def meets(self, other: _Way) -> bool:
        pairs = product(self._bases, other._bases)
        if all(np.linalg.norm(one - two) > its + theirs + CUBE_M for (one, its), (two, theirs) in pairs):
            return False
        return self._space.meets(other._space)


def _group_by_arm(motions: Sequence[RefinedMotion]) -> dict[str, _Way]:
    arms = sorted({each.arm for each in motions})
    return {arm: _Way([each for each in motions if each.arm == arm]) for arm in arms}


def _find_meeting(early: dict[str, _Way], late: dict[str, _Way]) -> tuple[str, str] | None:
    pairs = product(early.items(), late.items())
    return next(((one, other) for (one, its), (other, theirs) in pairs if one != other and its.meets(theirs)), None)
