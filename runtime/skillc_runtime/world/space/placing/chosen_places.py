"""Where a held thing may be put down, and the facts that say that one of these places was chosen for it.

Planner, look and run choose here. A chosen place is a placing pose of the place that is reserved for the thing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Pose
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.world.space.frames import frame_name, placement_changes, pose, size
from skillc_runtime.world.space.placing.free_places import list_free_places
from skillc_runtime.world.space.placing.held_load import pose_in_hand
from skillc_runtime.world.space.placing.no_place import PlaceError
from skillc_runtime.world.space.placing.placing_poses import list_placing_poses
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, RemoveIndividual
from skillc_runtime.world.state.terms import HAS_A, IS_TAKEN, PLACING_POSE, RESERVED_FOR

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState

FELT_M = 0.05
"""How far from where something was felt a thing is put down."""


@dataclass(frozen=True, slots=True, eq=False)
class PossiblePlace:
    """Where a held thing may stand: the pose in the world of the thing as a tool, and on what; `board` of a shelf.

    `support` is a placing pose if the place is `stated`.
    """

    support: str
    tool: Pose
    board: int = 0
    stated: bool = False


def list_places(state: WorldState, arm: str, gripper: str, thing: str, to: str) -> Iterator[PossiblePlace]:
    """Yield where a held thing may be put down at a place, the best first: at stated poses, else where it stands free.

    A pose that is reserved for the thing comes first, and then the others. PlaceError if there is none; FrameError,
    MissingFact or SheetError if facts are missing.
    """
    poses = list_placing_poses(state, thing, to)
    chosen = chosen_place(thing, to)
    yield from (PossiblePlace(each, pose(state, each), stated=True) for each in poses)
    if any(not state.objects(each, RESERVED_FOR) for each in poses):
        return
    held = pose_in_hand(state, gripper, thing) @ working_face(size(state, thing))
    felt_m = pose(state, chosen).position if chosen in state.individuals and state.value(chosen, IS_TAKEN) else None
    clear = False
    for free in list_free_places(state, arm, gripper, thing, to):
        tool = free.hand @ held
        if felt_m is None or float(np.linalg.norm(tool.position - felt_m)) > FELT_M:
            clear = True
            yield PossiblePlace(free.support.individual, tool, free.support.board)
    if not clear:
        short = state.vocabulary.short
        raise PlaceError(f"{short(thing)} cannot be put down at {short(to)}: something was felt there", "free room")


def chosen_place(thing: str, to: str) -> str:
    """Return the IRI of the placing pose that is chosen for a thing at a place."""
    return f"{thing}-in-{local_name(to)}"


def reservation_changes(state: WorldState, thing: str, to: str, support: str, at: Pose) -> list[Change]:
    """Return the changes that reserve a place for a thing, with its pose as a tool there.

    There are none if `support` is the place that is reserved for it already. at: pose in the frame of the support.
    """
    chosen = chosen_place(thing, to)
    if support == chosen:
        return []
    return [
        *end_of_reservation(state, thing, to),
        AddIndividual(chosen, (PLACING_POSE,)),
        AddRelation(to, HAS_A, chosen),
        AddRelation(chosen, RESERVED_FOR, thing),
        *placement_changes(chosen, at, frame_name(state, support)),
    ]


def end_of_reservation(state: WorldState, thing: str, to: str) -> list[Change]:
    """Return the changes with which no place is chosen for a thing any more; none if none is."""
    chosen = chosen_place(thing, to)
    return [RemoveIndividual(chosen)] if chosen in state.individuals else []


def at_support(state: WorldState, place: PossiblePlace) -> Pose:
    """Return the pose of the thing, as a tool, in the frame of what it is put on."""
    return pose(state, place.support).inverse() @ place.tool
