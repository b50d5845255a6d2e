"""All checks of a cell, in the order in which a user would put things right."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain
from typing import TypeAlias

from skillc.services.cell_checks.bodies import WITHOUT_POSE, check_bodies
from skillc.services.cell_checks.grasps import check_grasps
from skillc.services.cell_checks.model_sizes import check_model_sizes
from skillc.services.cell_checks.overlaps import check_overlaps
from skillc.services.cell_checks.places import check_goal_places, check_places
from skillc.services.cell_checks.poses import check_poses
from skillc.services.cell_checks.reach import check_reach
from skillc.services.cell_checks.start_postures import check_start_postures
from skillc.services.cell_checks.support import check_support
from skillc_model.conditions import Condition
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.occupants import Occupant, read_occupants
from skillc_runtime.world.state.world_state import WorldState

CellCheck: TypeAlias = Callable[[WorldState, tuple[Occupant, ...]], Iterable[SceneViolation]]

CHECKS: tuple[CellCheck, ...] = (
    check_bodies,
    check_model_sizes,
    check_grasps,
    check_overlaps,
    check_start_postures,
    check_poses,
    check_support,
    check_reach,
    check_places,
)


def check_cell(state: WorldState, goals: Sequence[Condition] = ()) -> tuple[SceneViolation, ...]:
    """Return everything that is wrong with the things in a cell, also because of goals, each once.

    Checks of terms that the cell does not have find nothing.
    """
    occupants = read_occupants(state)
    wanted = chain.from_iterable(check_goal_places(state, goal) for goal in goals)
    found = list(chain(chain.from_iterable(check(state, occupants) for check in CHECKS), wanted))
    return tuple(_without_consequences(_without_general(found)))


def _without_general(found: Sequence[SceneViolation]) -> list[SceneViolation]:
    """Return violations without those of individuals for which there is the same one with others that take part."""
    special = {(each.individual, each.name) for each in found if each.others}
    return [each for each in found if each.others or (each.individual, each.name) not in special]


def _without_consequences(found: Sequence[SceneViolation]) -> Iterator[SceneViolation]:
    """Yield violations without those that follow from a pose that is not there."""
    lost = {each.individual for each in found if each.name == WITHOUT_POSE}
    yield from (each for each in found if each.name == WITHOUT_POSE or lost.isdisjoint((each.individual, *each.others)))
