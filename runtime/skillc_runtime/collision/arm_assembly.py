"""An arm with its gripper and the objects that it holds, read from the world model."""

from __future__ import annotations

import msgspec

from skillc_runtime.collision.scenery import SolidObstacle, make_obstacles, pose_key
from skillc_runtime.world.space.bodies import has_body, read_solids
from skillc_runtime.world.space.frame_tree import MissingFact, frame_tree_of
from skillc_runtime.world.space.frames import frame_name, size
from skillc_runtime.world.state.data_sheet import number_of, sheet_of
from skillc_runtime.world.state.terms import BASE_FRAME_ID, CLEARANCE, CONTAIN, HAS_GRIPPER
from skillc_runtime.world.state.world_state import WorldState


class Hand(msgspec.Struct, frozen=True):
    """A gripper: its short name, its MJCF, the distance of its fingers in m, held solids in the frame of its `tcp`."""

    name: str
    model: str
    opening_m: float
    held: tuple[SolidObstacle, ...]


class ArmAssembly(msgspec.Struct, frozen=True):
    """An arm: its short name, its MJCF, its hand, and the clearance in m that it keeps from obstacles."""

    name: str
    model: str
    hand: Hand | None
    clearance_m: float


def read_arm_assembly(state: WorldState, arm: str, opening_m: dict[str, float]) -> ArmAssembly:
    """Return an arm with its gripper and held objects.

    `opening_m` has the distance of the fingers of each gripper, by IRI.

    Raises SheetError if a data sheet has no model.
    """
    sheet = sheet_of(state, arm)
    grippers = sorted(state.objects(arm, HAS_GRIPPER))
    return ArmAssembly(
        name=state.vocabulary.short(arm),
        model=str(sheet.model),
        hand=_hand(state, grippers[0], opening_m[grippers[0]]) if grippers else None,
        clearance_m=number_of(state, sheet.individual, CLEARANCE, default=0.0),
    )


def _hand(state: WorldState, gripper: str, opening_m: float) -> Hand:
    model = str(sheet_of(state, gripper).model)
    frame = frame_name(state, gripper)
    inside = sorted(state.objects(gripper, CONTAIN))
    things = (thing for thing in inside if state.value(thing, BASE_FRAME_ID) == frame)
    held = tuple(each for thing in things for each in _held(state, thing))
    return Hand(state.vocabulary.short(gripper), model, round(opening_m, 3), held)


def _held(state: WorldState, thing: str) -> tuple[SolidObstacle, ...]:
    """Return the solids of a held body, or the box of another object; none if size or pose in the hand is not known."""
    name = state.vocabulary.short(thing)
    try:
        at = frame_tree_of(state).own_pose(thing)
        if has_body(state, thing):
            return tuple(make_obstacles(name, read_solids(state, thing), at))
        return (SolidObstacle(name, pose_key(at), tuple((size(state, thing) / 2).tolist())),)
    except MissingFact:
        return ()
