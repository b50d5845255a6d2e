"""All checks of a cell, in the order in which a user would put things right."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain
from typing import TypeAlias

from skillc.services.cell_checks.bodies import WITHOUT_POSE, check_bodies
from skillc.services.cell_checks.facts import ROUNDED_M, placing_fact, severity_of
from skillc.services.cell_checks.model_sizes import check_model_sizes
from skillc.services.cell_checks.places import check_goal_places, check_places
from skillc.services.cell_checks.poses import check_poses
from skillc.services.cell_checks.reach import check_reach
from skillc.services.cell_checks.start_postures import check_start_postures
from skillc.services.cell_checks.support import check_support
from skillc_model.conditions import Condition
from skillc_runtime.collision.solid_geoms import overlap_depths
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.grasping.grasps import grasp_problem
from skillc_runtime.world.space.grasping.grip_force import GraspError
from skillc_runtime.world.space.occupants import Occupant, near_pairs, read_occupants
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import (
    CAN_GRASP,
    END_EFFECTOR,
    GRASP_WIDTH,
    MANIPULATABLE,
    MOBILE_ROBOT,
    SIZE,
    WEIGHT,
)
from skillc_runtime.world.state.world_state import WorldState


def check_overlaps(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield each pair of things that overlap, one of which lies free or drives; what is fixed may overlap."""
    pairs = [(one, other) for one, other in near_pairs(occupants) if _moves(state, one) or _moves(state, other)]
    depths = overlap_depths([(one.solids, other.solids) for one, other in pairs])
    for (one, other), depth_m in zip(pairs, depths, strict=True):
        if depth_m > ROUNDED_M:
            yield _overlap(state, *_ordered(state, one, other), depth_m)


def _moves(state: WorldState, one: Occupant) -> bool:
    return one.movable or state.is_a(one.individual, MOBILE_ROBOT)


def _ordered(state: WorldState, one: Occupant, other: Occupant) -> tuple[str, str]:
    """Return two things, the one first that moves, and of two that move the one that comes first by IRI."""
    first, second = sorted((one, other), key=lambda each: (not _moves(state, each), each.individual))
    return first.individual, second.individual


def _overlap(state: WorldState, thing: str, other: str, depth_m: float) -> SceneViolation:
    short = state.vocabulary.short
    message = f"{short(thing)} is {1e3 * depth_m:.0f} mm inside {short(other)}"
    cure = f"move one of them by {1e3 * depth_m:.0f} mm, or write their true sizes"
    place = placing_fact(state, thing)
    return SceneViolation(thing, place, "inside-another", message, cure, severity_of(depth_m), (other,))


def check_grasps(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield things to handle that no gripper can grasp, and why the widest cannot; none if one is not known."""
    try:
        grippers = sorted(state.instances(END_EFFECTOR), key=lambda each: (-_opening_m(state, each), each))
    except SheetError:
        return
    for thing in (each.individual for each in occupants if state.is_a(each.individual, MANIPULATABLE)):
        try:
            problems = [grasp_problem(state, gripper, thing) for gripper in grippers]
        except (SheetError, FrameError):
            continue
        known = [each for each in problems if each is not None]
        if known and len(known) == len(grippers):
            yield _violation(state, thing, known[0])


def _opening_m(state: WorldState, gripper: str) -> float:
    return sheet_of(state, gripper).number("maxOpening")


def _violation(state: WorldState, thing: str, problem: GraspError) -> SceneViolation:
    """Return a warning, because other tasks may use the thing without holding it."""
    wanted = (WEIGHT,) if problem.name == "too-heavy" else (GRASP_WIDTH, SIZE[0])
    place = next((each for each in wanted if state.value(thing, each) is not None), None)
    return SceneViolation(thing, place, problem.name, problem.problem, problem.cure, "warning", prevents=CAN_GRASP)


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
