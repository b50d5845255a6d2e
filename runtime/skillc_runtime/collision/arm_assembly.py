"""An arm with its gripper and the objects that it holds, read from the world model."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_runtime.collision.scenery import BoxObstacle, pose_key
from skillc_runtime.world.space.frame_tree import MissingFact, frame_tree_of
from skillc_runtime.world.space.frames import size
from skillc_runtime.world.state.data_sheet import number_of, sheet_of
from skillc_runtime.world.state.terms import BASE_FRAME_ID, CLEARANCE, CONTAIN, FRAME_ID, HAS_GRIPPER
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class Hand:
    """A gripper: its short name, its MJCF, the distance of its fingers in m, held boxes in the frame of its `tcp`."""

    name: str
    model: str
    opening_m: float
    held: tuple[BoxObstacle, ...]


@dataclass(frozen=True, slots=True)
class ArmAssembly:
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
    frame = state.value(gripper, FRAME_ID)
    inside = sorted(state.objects(gripper, CONTAIN))
    held = (_held(state, thing) for thing in inside if state.value(thing, BASE_FRAME_ID) == frame)
    return Hand(state.vocabulary.short(gripper), model, round(opening_m, 3), tuple(one for one in held if one))


def _held(state: WorldState, thing: str) -> BoxObstacle | None:
    """Return the box of a held object, None if its size or its pose in the hand is not known."""
    try:
        at, half = frame_tree_of(state).own_pose(thing), size(state, thing) / 2
    except MissingFact:
        return None
    return BoxObstacle(state.vocabulary.short(thing), pose_key(at), tuple(half.tolist()))
