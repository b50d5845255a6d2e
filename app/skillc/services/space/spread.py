"""Where surfaces may really be, as a scene states it, and whether all goes there, too.

A run measures where a surface is, and its tool follows it, so that joints have to go there, in the postures that were
planned. Lanes are judged as a run does then, which has no other place to choose.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import degrees

import numpy as np

from skillc_model import tree
from skillc_model.conditions import Individual
from skillc_model.skills import SkillLibrary
from skillc_model.traversal import find_calls
from skillc_model.traversal import walk as walk_parts
from skillc_runtime.control.feasibility import RANGE_TOLERANCE_RAD
from skillc_runtime.execution.refinement.failure import SpaceFailure
from skillc_runtime.execution.refinement.situation import RefinedMotion, Situation
from skillc_runtime.execution.refinement.walk import Scope, Walk
from skillc_runtime.motion.pose import Pose, exp
from skillc_runtime.primitives.planned_postures import PlannedPosture
from skillc_runtime.world.space.frames import place_changes, pose
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import OFFSET_RANGE, SURFACE, TILT_RANGE
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class PossiblePlace:
    """A place where a surface may really be: offset_m along its z axis, tilted by tilt_rad about its x and y axes."""

    thing: str
    offset_m: float
    tilt_rad: tuple[float, float]

    def changes(self, state: WorldState) -> list[Change]:
        """Return the changes that bring the thing there from where a version of the world has it."""
        there = Pose(np.array([0.0, 0.0, self.offset_m]), exp(np.array([*self.tilt_rad, 0.0])))
        return place_changes(state, self.thing, pose(state, self.thing) @ there)

    @property
    def text(self) -> str:
        """It as a clause, such as `10 mm along its z axis and tilted by 5 and -5 deg about its x and y axes`."""
        offset = [f"{1e3 * self.offset_m:.0f} mm along its z axis"] if self.offset_m else []
        x, y = map(degrees, self.tilt_rad)
        return " and ".join(
            [*offset, *([f"tilted by {x:.1f} and {y:.1f} deg about its x and y axes"] if x or y else [])]
        )


@dataclass(frozen=True, slots=True)
class PlannedPart:
    """A part of a plan or a body that goes in a situation, the individuals that it names, and how arms move in it."""

    node: tree.Node
    before: Situation
    named: tuple[str, ...]
    motions: tuple[RefinedMotion, ...]

    @property
    def planned(self) -> tuple[PlannedPosture, ...]:
        """The postures in which arms bring their tools to poses."""
        return tuple(PlannedPosture(m.arm, m.tool, m.postures[-1]) for m in self.motions if m.tool is not None)


def list_possible_places(state: WorldState, individual: str) -> tuple[PossiblePlace, ...]:
    """Return the corners of the middle half of where a surface may really be; none of others, or without such facts.

    That half of the places, all of which are as likely, is a box in offset and tilt with sides 0.5^(1/n) as long, n of
    which are not 0. The extremes of all at once do not come in practice.
    """
    if not state.is_a(individual, SURFACE):
        return ()
    offset_m, tilt_rad = (_find_range(state, individual, each) for each in (OFFSET_RANGE, TILT_RANGE))
    sides = (offset_m, tilt_rad, tilt_rad)
    count = sum(each > 0.0 for each in sides)
    if not count:
        return ()
    share = 0.5 ** (1.0 / count)
    corners = product(*({-share * each, share * each} for each in sides))
    return tuple(PossiblePlace(individual, offset, (x, y)) for offset, x, y in sorted(corners))


def find_displacement(
    library: SkillLibrary, parts: Iterable[PlannedPart]
) -> tuple[PlannedPart, PossiblePlace, SpaceFailure] | None:
    """Return the first part that does not go with a surface that it names where that may be, and why; None if all do.

    Cancelled as `cancellation.cancelling` says.
    """
    for part in parts:
        for displaced in _list_of_part(part):
            failure = find_failure(library, part, displaced)
            if failure is not None:
                return part, displaced, failure
    return None


def goes_everywhere(library: SkillLibrary, part: PlannedPart, changes: Sequence[Change], first: PossiblePlace) -> bool:
    """Whether after changes of the world a part goes wherever the things may be that it names.

    `first` is where it is tried first.
    """
    before = part.before.with_changes(list(changes))
    end = next(Walk(library).go(part.node, before, Scope({})), None)
    if end is None:
        return False
    there = replace(part, before=before, motions=end.motions[len(before.motions) :])
    places = sorted(_list_of_part(part), key=lambda each: each != first)
    return all(find_failure(library, there, each) is None for each in places)


def find_failure(library: SkillLibrary, part: PlannedPart, displaced: PossiblePlace) -> SpaceFailure | None:
    """Return why a part does not go with a thing elsewhere; None if it does, or nobody can say.

    Nobody can of calls that do not name the thing: where others stand that are on it, or beside it, is not known.
    """
    state = WorldModel(part.before.state).commit(displaced.changes(part.before.state)).after
    walk = Walk(library)
    there = replace(part.before, state=state, planned=part.planned, slack_rad=RANGE_TOLERANCE_RAD)
    if next(walk.go(part.node, there, Scope({})), None) is not None:
        return None
    failure = walk.furthest
    if failure is None or not failure.is_in_space:
        return None
    failed = [each for each in find_calls(part.node) if each.source == failure.source]
    return failure if not failed or any(_names(each, displaced.thing) for each in failed) else None


def _names(call: tree.Call, individual: str) -> bool:
    return any(isinstance(each, Individual) and each.iri == individual for each in walk_parts(call))


def _list_of_part(part: PlannedPart) -> Iterator[PossiblePlace]:
    for each in part.named:
        yield from list_possible_places(part.before.state, each)


def _find_range(state: WorldState, individual: str, name: str) -> float:
    value = state.value(individual, name) if name in state.stored else None
    return float(value) if isinstance(value, int | float) else 0.0
