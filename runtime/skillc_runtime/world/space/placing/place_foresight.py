"""Whether a thing can be put down somewhere, before it is grasped."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from itertools import chain
from typing import Final

from skillc_model.conditions import Condition, Holds, Individual
from skillc_model.traversal import conjuncts
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import frame_name, moves_with, pose, relocation_changes
from skillc_runtime.world.space.grasping.grasp_geometry import GraspCandidate, is_sideways
from skillc_runtime.world.space.grasping.grasps import find_grasp, find_grasps
from skillc_runtime.world.space.grasping.grip_force import GraspError
from skillc_runtime.world.space.placing.free_places import free_hand_pose
from skillc_runtime.world.space.placing.no_place import PlaceError
from skillc_runtime.world.space.placing.placing_poses import find_placing_pose
from skillc_runtime.world.state.changes import AddRelation, RemoveRelation, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.python_calls import InsufficientFacts
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    CONTAIN,
    CONTAINER,
    FIXTURE,
    HAS_GRIPPER,
    HELD_SIDEWAYS,
    LOCATION,
    MANIPULATABLE,
    MOBILE_ROBOT,
    SIZE,
    TRAVEL,
)
from skillc_runtime.world.state.world_state import WorldState

PLACE_POSE: Final = "skillc_runtime.world.handling:place_pose"
"""The function that says where a held thing is put down."""


def uses_place_pose(state: WorldState) -> bool:
    """Whether a library puts things down by `place_pose`: skills of its own may do it in another way."""
    return any(each.python == PLACE_POSE for each in state.vocabulary.functions.values())


def list_wanted(state: WorldState, goal: Condition) -> Iterator[tuple[str, str]]:
    """Yield the things that are elsewhere with the containers in which a goal wants them."""
    for each in conjuncts(goal):
        match each:
            case Holds(subject=Individual(container), relation=relation, object=Individual(thing)):
                known = relation == CONTAIN and {container, thing} <= state.individuals
                sized = known and state.value(thing, SIZE[0]) is not None
                reported = state.is_a(container, CONTAINER) and state.value(container, SIZE[0]) is None
                put_down = sized and not reported and _is_place(state, container) and state.is_a(thing, MANIPULATABLE)
                if put_down and not state.holds(container, CONTAIN, thing):
                    yield thing, container
            case _:
                pass


def _is_place(state: WorldState, individual: str) -> bool:
    """Whether things are put down there, not inserted into it or held by it."""
    return state.is_a(individual, LOCATION) and not state.is_a(individual, FIXTURE)


def find_place_problem(state: WorldState, thing: str, container: str) -> PlaceError | None:
    """Return why no arm can put a thing into a container; None if one can, or if that is not known."""
    hands = [(arm, hand) for arm in state.instances(ARM_DEVICE) for hand in state.objects(arm, HAS_GRIPPER)]
    problem: PlaceError | None = None
    try:
        stated = find_placing_pose(state, thing, container)
    except PlaceError as taken:
        return taken
    if stated is not None or state.value(container, TRAVEL) is not None:
        return None
    for arm, hand in sorted(hands):
        with suppress(GraspError):
            try:
                problem = place_problem(state, arm, hand, thing, container)
            except (SheetError, FrameError, InsufficientFacts):
                return None
            if problem is None or (problem.lack == "reach" and (_drives(state, arm) or _drives(state, container))):
                return None
    return problem


def _drives(state: WorldState, individual: str) -> bool:
    return any(moves_with(state, individual, robot) for robot in state.instances(MOBILE_ROBOT))


def place_problem(state: WorldState, arm: str, gripper: str, thing: str, to: str) -> PlaceError | None:
    """Return why a thing cannot be put down however it is grasped where it is now; None if it can be.

    GraspError if it cannot be grasped; FrameError, MissingFact or SheetError if facts are missing.
    """
    grasps = chain(find_grasps(state, gripper, thing), _find_by_top(state, gripper, thing))
    problems = (_problem_of_grasp(state, arm, gripper, thing, to, each.tool) for each in grasps)
    first = next(problems)
    return first if first is None or all(problems) else None


def _find_by_top(state: WorldState, gripper: str, thing: str) -> Iterator[GraspCandidate]:
    with suppress(GraspError):
        yield find_grasp(state, gripper, thing, "top")


def _problem_of_grasp(state: WorldState, arm: str, gripper: str, thing: str, to: str, tool: Pose) -> PlaceError | None:
    """Return why a thing cannot be put down that is grasped with the tool at a pose; None if it can be."""
    in_hand = tool.inverse() @ pose(state, thing)
    taken = [RemoveRelation(each, CONTAIN, thing) for each in sorted(state.subjects(CONTAIN, thing))]
    moved = relocation_changes(state, thing, in_hand, frame_name(state, gripper))
    sideways = SetProperty(thing, HELD_SIDEWAYS, is_sideways(tool))
    held = state.with_changes([*taken, AddRelation(gripper, CONTAIN, thing), *moved, sideways])
    try:
        free_hand_pose(held, arm, gripper, thing, to)
    except PlaceError as error:
        return error
    return None
