"""Which steps of a plan may not run at the same time: their arms, or their bases, would come into one place."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress
from functools import cached_property
from itertools import combinations, pairwise, product

import numpy as np

from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import check_current
from skillc_runtime.collision.swept_space import CUBE_M, SweptSpace, join_spaces
from skillc_runtime.execution.refinement.situation import BaseDrive, RefinedMotion
from skillc_runtime.motion.pose import Array
from skillc_runtime.planning.arrangement import find_predecessors
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.planning.validation import PlanError
from skillc_runtime.recording.space_claim import StepsApart
from skillc_runtime.world.state.world_state import WorldState

SAMPLED_M = 0.05
"""How far from each other the points are at which the ways of bases are compared."""


def find_steps_apart(
    library: SkillLibrary,
    state: WorldState,
    steps: Sequence[Step],
    moving: Sequence[tuple[Sequence[RefinedMotion], Sequence[BaseDrive]]],
) -> tuple[StepsApart, ...]:
    """Return which steps have to run one after the other although facts let them overlap.

    moving: the motions of arms and the drives of bases in each.

    An arm sweeps its places at the begin and at the end of its motions, too. So whatever two steps do that neither wait
    for each other nor are named here, each arm may stand anywhere on its way meanwhile.
    """
    arms, bases = {each.arm for one, _ in moving for each in one}, {each.robot for _, one in moving for each in one}
    if max(len(arms), len(bases)) < 2:
        return ()
    spaces, short = [_group_by_arm(each) for each, _ in moving], state.vocabulary.short
    before = [set(each) for each in _find_predecessors(library, state, steps)]
    found = list[StepsApart]()
    for late in range(len(steps)):
        before[late] |= {first for each in before[late] for first in before[each]}
        for early in reversed(range(late)):
            check_current()
            if early in before[late]:
                continue
            meeting = _find_meeting(spaces[early], spaces[late]) or find_meeting_bases(
                moving[early][1], moving[late][1]
            )
            if meeting is not None:
                one, other = meeting
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


def find_meeting_bases(early: Iterable[BaseDrive], late: Iterable[BaseDrive]) -> tuple[str, str] | None:
    """Return two bases that would come near each other on drives, which also are where they start and end."""
    for one, other in product(early, late):
        if one.robot != other.robot:
            first, second = _sample(one.points), _sample(other.points)
            nearest_m = float(np.linalg.norm(first[:, None] - second[None], axis=2).min())
            if nearest_m < one.radius_m + other.radius_m + SAMPLED_M:
                return one.robot, other.robot
    return None


def _sample(points: Sequence[tuple[float, float]]) -> Array:
    """Return points (n, 2) in m on a way, at most SAMPLED_M from each other."""
    corners = np.array(points)
    parts = [corners[:1]]
    for one, other in pairwise(corners):
        count = int(np.ceil(np.linalg.norm(other - one) / SAMPLED_M)) + 1
        parts.append(np.linspace(one, other, count)[1:])
    return np.concatenate(parts)


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
