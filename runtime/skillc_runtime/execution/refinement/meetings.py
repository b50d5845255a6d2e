"""Which steps of a plan may not run at the same time: their arms, or their bases, would come into one place."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from functools import cached_property
from itertools import chain, combinations, pairwise, product

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
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

SAMPLED_M = 0.05
"""How far from each other the points are at which the ways of bases are compared."""


class Moving:
    """What moves in a step, or in a part of a body: `motions` of arms and `drives` of bases.

    `used` are the individuals that it uses from its start to its end: what others that use them move, moves at another
    time.
    """

    def __init__(
        self, motions: Sequence[RefinedMotion], drives: Sequence[BaseDrive], used: frozenset[Value] = frozenset()
    ) -> None:
        self.motions, self.drives, self.used = motions, drives, used

    @cached_property
    def _ways(self) -> dict[str, _Way]:
        arms = sorted({each.arm for each in self.motions})
        return {arm: _Way([each for each in self.motions if each.arm == arm]) for arm in arms}

    def find_meeting(self, other: Moving) -> tuple[str, str] | None:
        """Return two arms or bases that would come into one place if both moved at the same time: first one of this."""
        if self.used & other.used:
            return None
        return next(chain(self._list_meetings(other), ((its, one) for one, its in other._list_under(self))), None)

    def _list_meetings(self, other: Moving) -> Iterator[tuple[str, str]]:
        for (one, its), (another, theirs) in product(self._ways.items(), other._ways.items()):
            if one != another and its.meets(theirs):
                yield one, another
        bases = _find_meeting_bases(self.drives, other.drives)
        if bases is not None:
            yield bases
        yield from self._list_under(other)

    def _list_under(self, other: Moving) -> Iterator[tuple[str, str]]:
        """Yield bases with the arms of the other that are in their way; not their own ones."""
        for drive, (arm, way) in product(self.drives, other._ways.items()):
            if arm not in drive.arms and way.meets_base(drive):
                yield drive.robot, arm


def find_steps_apart(
    library: SkillLibrary,
    state: WorldState,
    steps: Sequence[Step],
    moving: Sequence[Moving],
) -> tuple[StepsApart, ...]:
    """Return which steps have to run one after the other although facts let them overlap.

    moving: what moves in each.

    An arm sweeps its places at the begin and at the end of its motions, too. So whatever two steps do that neither wait
    for each other nor are named here, each arm may stand anywhere on its way meanwhile.
    """
    if not _may_meet(moving):
        return ()
    short = state.vocabulary.short
    before = [set(each) for each in _find_predecessors(library, state, steps)]
    found = list[StepsApart]()
    for late in range(len(steps)):
        before[late] |= {first for each in before[late] for first in before[each]}
        for early in reversed(range(late)):
            check_current()
            if early in before[late]:
                continue
            meeting = moving[early].find_meeting(moving[late])
            if meeting is not None:
                one, other = meeting
                found.append(StepsApart(early + 1, late + 1, (short(one), short(other))))
                before[late] |= {early, *before[early]}
    return tuple(found)


def find_meeting(moving: Sequence[Moving]) -> tuple[str, str] | None:
    """Return two arms or bases that come into one place, of what moves at the same time."""
    if not _may_meet(moving):
        return None
    return next((found for one, other in combinations(moving, 2) if (found := one.find_meeting(other))), None)


def _may_meet(moving: Sequence[Moving]) -> bool:
    """Whether anything moves that another thing does not carry: a base carries its arms."""
    bases = {each.robot for one in moving for each in one.drives}
    carried = {arm for one in moving for each in one.drives for arm in each.arms}
    return len(bases) + len({each.arm for one in moving for each in one.motions} - carried) > 1


def _find_meeting_bases(early: Iterable[BaseDrive], late: Iterable[BaseDrive]) -> tuple[str, str] | None:
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

    def meets_base(self, drive: BaseDrive) -> bool:
        points, away_m = _sample(drive.points), drive.radius_m + CUBE_M
        nearest = ((np.linalg.norm(points - base[:2], axis=1).min(), reach_m) for base, reach_m in self._bases)
        if all(far_m > reach_m + away_m for far_m, reach_m in nearest):
            return False
        return self._space.is_near(points, away_m, drive.top_m)
