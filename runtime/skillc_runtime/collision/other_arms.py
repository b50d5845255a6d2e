"""The other arms of a cell as obstacles around an arm: where they stand, with their hands and what these hold."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress

import numpy as np

from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.arm_parts import ArmParts
from skillc_runtime.collision.scenery import FAR_M, SolidObstacle
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import HAS_GRIPPER
from skillc_runtime.world.state.world_state import WorldState


def read_other_arms(
    state: WorldState, arm: str, base: Pose, postures: Mapping[str, Array], openings: Mapping[str, float]
) -> tuple[SolidObstacle, ...]:
    """Return the parts of all arms but one that stand in postures, in the frame of the base of that one.

    postures: (nv,) in rad, by IRI. openings: m, of grippers by IRI; the fingers of others are open. Left out are arms
    that are too far away, of which a model or the place is not known, or to whose model the posture does not belong.
    """
    return tuple(
        part
        for other, q in sorted(postures.items(), key=lambda each: each[0])
        if other != arm
        for part in _read_parts(state, other, base.inverse(), q, openings)
    )


def _read_parts(
    state: WorldState, arm: str, inward: Pose, q: Array, openings: Mapping[str, float]
) -> Iterator[SolidObstacle]:
    with suppress(FrameError, SheetError, ValueError):
        base = inward @ pose(state, arm)
        if np.linalg.norm(base.position) < FAR_M:
            known = {each: _opening_m(state, each, openings) for each in state.objects(arm, HAS_GRIPPER)}
            yield from tuple(ArmParts(read_arm_assembly(state, arm, known)).list_obstacles(q, base))


def _opening_m(state: WorldState, gripper: str, openings: Mapping[str, float]) -> float:
    known = openings.get(gripper)
    return sheet_of(state, gripper).number("maxOpening") if known is None else known
