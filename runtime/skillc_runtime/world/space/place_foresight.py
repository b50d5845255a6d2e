"""Whether a thing can be put down somewhere, before it is grasped."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from itertools import chain

from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.frames import frame_name, pose, relocation_changes
from skillc_runtime.world.space.free_places import free_hand_pose
from skillc_runtime.world.space.grasp_geometry import GraspCandidate, is_sideways
from skillc_runtime.world.space.grasps import find_grasp, find_grasps
from skillc_runtime.world.space.grip_force import GraspError
from skillc_runtime.world.space.no_place import PlaceError
from skillc_runtime.world.state.changes import AddRelation, RemoveRelation, SetProperty
from skillc_runtime.world.state.terms import CONTAIN, HELD_SIDEWAYS
from skillc_runtime.world.state.world_state import WorldState


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
