"""All checks of a cell, in the order in which a user would put things right."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import chain
from typing import TypeAlias

from skillc.services.cell_checks.bodies import check_bodies
from skillc.services.cell_checks.grasps import check_grasps
from skillc.services.cell_checks.model_sizes import check_model_sizes
from skillc.services.cell_checks.overlaps import check_overlaps
from skillc.services.cell_checks.poses import check_poses
from skillc.services.cell_checks.reach import check_reach
from skillc.services.cell_checks.support import check_support
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.occupants import Occupant, read_occupants
from skillc_runtime.world.state.world_state import WorldState

CellCheck: TypeAlias = Callable[[WorldState, tuple[Occupant, ...]], Iterable[SceneViolation]]

CHECKS: tuple[CellCheck, ...] = (
    check_bodies,
    check_model_sizes,
    check_grasps,
    check_overlaps,
    check_poses,
    check_support,
    check_reach,
)


def check_cell(state: WorldState) -> tuple[SceneViolation, ...]:
    """Return everything that is wrong with the things in a cell; checks of terms that it does not have find nothing."""
    occupants = read_occupants(state)
    return tuple(chain.from_iterable(check(state, occupants) for check in CHECKS))
