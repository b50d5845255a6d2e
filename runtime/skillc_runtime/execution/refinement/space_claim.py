"""What a refinement of a plan claims."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from msgspec import structs

from skillc_runtime.recording.space_claim import (
    ChosenImplementation,
    ChosenPosture,
    PlaceAt,
    SpaceClaim,
    StandAt,
    UnseenCall,
    WayAround,
)
from skillc_runtime.world.state.labels.labelling import label, label_pose

if TYPE_CHECKING:
    from skillc_rdf.vocabulary.types import Vocabulary
    from skillc_runtime.execution.refinement.plan_refinement import PlanRefinement
    from skillc_runtime.execution.refinement.situation import (
        ChosenPlace,
        ChosenStand,
        ChosenWay,
        RefinedMotion,
        Situation,
    )
    from skillc_runtime.execution.refinement.walk import Walk


def make_claim(found: PlanRefinement, steps: int, words: Vocabulary, from_home: bool = True) -> SpaceClaim:
    """Return what a refinement of so many steps says, in these words; `from_home` if the arms begin at home."""
    failure = None
    if found.failed is not None:
        failure = "no way was found" if found.failure is None else found.failure.message
    return SpaceClaim(
        checked=len(found.steps),
        steps=steps,
        unseen=tuple(UnseenCall(number, call) for number, each in enumerate(found.steps, 1) for call in each.unseen),
        postures=tuple(
            each for number, step in enumerate(found.steps, 1) for each in _postures_of(number, step.motions, words)
        ),
        apart=found.apart,
        stands=tuple(each for number, step in enumerate(found.steps, 1) for each in _stands_of(number, step.stands)),
        places=tuple(each for number, step in enumerate(found.steps, 1) for each in _places_of(number, step.places)),
        implementations=tuple(
            ChosenImplementation(number, each.step.skill, each.implementation)
            for number, each in enumerate(found.steps, 1)
            if each.implementation
        ),
        ways=tuple(each for number, step in enumerate(found.steps, 1) for each in _ways_of(number, step.ways)),
        failure=failure,
        from_home=from_home,
    )


def claim_of_body(found: Situation | None, walk: Walk, from_home: bool) -> SpaceClaim:
    """Return what is known of a body, which counts as one step, after a walk through it: None if it does not go."""
    failure = None if found is not None else "no way was found" if walk.furthest is None else walk.furthest.message
    return SpaceClaim(
        checked=0 if found is None else 1,
        steps=1,
        unseen=tuple(UnseenCall(1, call) for call in walk.unseen),
        postures=() if found is None else tuple(_postures_of(1, found.motions, found.state.vocabulary)),
        stands=() if found is None else tuple(_stands_of(1, found.stands)),
        places=() if found is None else tuple(_places_of(1, found.places)),
        ways=() if found is None else tuple(_ways_of(1, found.ways)),
        failure=failure,
        from_home=from_home,
    )


def _postures_of(step: int, motions: Iterable[RefinedMotion], words: Vocabulary) -> Iterator[ChosenPosture]:
    """Yield the postures that were found for poses of tools, in a step of a number."""
    for each in motions:
        if each.tool is not None:
            q = tuple(each.postures[-1].tolist())
            yield ChosenPosture(step, label(each.arm, words), q, label_pose(each.tool), label_pose(each.base))


def _stands_of(step: int, stands: Iterable[ChosenStand]) -> Iterator[StandAt]:
    """Yield where bases were let stand, in a step of a number."""
    for each in stands:
        yield StandAt(step, each.robot, each.place, each.x_m, each.y_m, each.yaw_rad)


def _places_of(step: int, places: Iterable[ChosenPlace]) -> Iterator[PlaceAt]:
    """Yield where things were let stand, in a step of a number."""
    for each in places:
        at = structs.replace(label_pose(each.at), frame=each.support.label)
        x, y, z = each.middle.tolist()
        yield PlaceAt(step, each.thing, each.place, each.support, at, each.board, each.stated, (x, y, z))


def _ways_of(step: int, ways: Iterable[ChosenWay]) -> Iterator[WayAround]:
    """Yield the ways of bases that are not straight, in a step of a number."""
    for each in ways:
        yield WayAround(step, each.robot, each.place, each.corners, each.around)
