"""The placing poses that a place states: the first one that is free, as far as is known or was felt."""

from __future__ import annotations

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.world.space.bounding_boxes import TOUCH_M
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose, size
from skillc_runtime.world.space.grasping.hand_shape import overlaps
from skillc_runtime.world.space.occupants import Occupant, read_occupants
from skillc_runtime.world.space.placing.no_place import PlaceError
from skillc_runtime.world.space.shape.oriented_box import OrientedBox
from skillc_runtime.world.state.terms import HAS_A, IS_TAKEN, PLACING_POSE, RESERVED_FOR
from skillc_runtime.world.state.world_state import WorldState


def find_placing_pose(state: WorldState, thing: str, to: str) -> str | None:
    """Return the first free placing pose of a place for a thing, in order of IRI; None if it states none for any thing.

    Those that are reserved for the thing come first; those that are for other things do not count. PlaceError if all
    that are for any thing are taken.
    """
    return next(iter(list_placing_poses(state, thing, to)), None)


def list_placing_poses(state: WorldState, thing: str, to: str) -> list[str]:
    """Return the free placing poses of a place for a thing, as of `find_placing_pose`; PlaceError as there."""
    stated = sorted(each for each in state.objects(to, HAS_A) if state.is_a(each, PLACING_POSE))
    if not stated:
        return []
    others = [each for each in read_occupants(state) if each.movable and each.individual != thing]
    reserved = {each: state.objects(each, RESERVED_FOR) for each in stated}
    own = [each for each in stated if thing in reserved[each] and _why_taken(state, thing, each, others) is None]
    reasons, free = list[str](), list[str]()
    for each in stated:
        if not reserved[each]:
            taken = _why_taken(state, thing, each, others)
            free += [each] if taken is None else []
            reasons += [] if taken is None else [taken]
    if own or free or not reasons:
        return [*own, *free]
    short = state.vocabulary.short
    raise PlaceError(f"{short(thing)} cannot be put down at {short(to)}: {'; '.join(reasons)}", "free room")


def _why_taken(state: WorldState, thing: str, stated: str, others: list[Occupant]) -> str | None:
    """Return why a thing cannot stand at a placing pose; None if it can."""
    short = state.vocabulary.short
    if state.value(stated, IS_TAKEN) is True:
        return f"something was felt at {short(stated)}, as {short(IS_TAKEN)} says"
    room = _room(state, thing, stated)
    blocker = next((each for each in others if room is not None and overlaps(room, each.solids)), None)
    return None if blocker is None else f"{short(blocker.individual)} is at {short(stated)}"


def _room(state: WorldState, thing: str, stated: str) -> OrientedBox | None:
    """Return the box of a thing that stands at a placing pose, without what may touch; None if it is not known."""
    try:
        extent = size(state, thing)
        standing = pose(state, stated) @ working_face(extent).inverse()
    except FrameError:
        return None
    return OrientedBox.of(standing, np.maximum(extent / 2 - TOUCH_M, TOUCH_M / 2))
