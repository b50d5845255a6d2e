"""Checks that the poses to grasp, approach and place things are not inside something, and that places have support."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from skillc.services.cell_checks.facts import ROUNDED_M, placing_fact, severity_of
from skillc_runtime.motion.pose import Array
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.occupants import Occupant
from skillc_runtime.world.state.terms import (
    APPROACH_POSE,
    GRASPING_POSE,
    HAS_A,
    MANIPULATABLE,
    PLACING_POSE,
)
from skillc_runtime.world.state.world_state import WorldState

DROP_M = 0.1
"""The least height in m over its support of a placing pose that cannot be meant: nothing may be dropped from there."""


def check_poses(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield poses of the hand inside something else, and placing poses under which nothing holds what is put there."""
    for cls in (GRASPING_POSE, APPROACH_POSE, PLACING_POSE):
        for individual in sorted(state.instances(cls)):
            try:
                point = pose(state, individual).position
            except FrameError:
                continue
            owners = state.subjects(HAS_A, individual)
            others = [each for each in occupants if each.individual not in owners]
            inside = list(_inside(state, individual, point, others))
            yield from inside
            if cls == PLACING_POSE and not inside:
                yield from _unsupported(state, individual, point, occupants)


def _inside(state: WorldState, individual: str, point: Array, others: list[Occupant]) -> Iterator[SceneViolation]:
    for each in others:
        depth_m = max(-box.overhang(point[None, :]) for box in each.boxes)
        if depth_m > ROUNDED_M and not each.movable:
            short = state.vocabulary.short
            message = f"the pose {short(individual)} is {1e3 * depth_m:.0f} mm inside {short(each.individual)}"
            cure = f"move it, or write the true size of {short(each.individual)}"
            yield SceneViolation(
                individual,
                placing_fact(state, individual),
                "pose-in-body",
                message,
                cure,
                severity_of(depth_m),
                (each.individual,),
            )


def _unsupported(
    state: WorldState, individual: str, point: Array, occupants: tuple[Occupant, ...]
) -> Iterator[SceneViolation]:
    """Yield a placing pose higher over what is below it than the greatest thing that could be put there."""
    x, y, z = point.tolist()
    fixed = [each for each in occupants if not each.movable]
    tops = [(top, each.individual) for each in fixed for box in each.boxes if (top := box.height_at(x, y)) is not None]
    height, below = max(((top, one) for top, one in tops if top <= z + ROUNDED_M), default=(0.0, ""))
    gap_m, short = z - height, state.vocabulary.short
    greatest_m = _greatest_m(occupants, state)
    if gap_m <= greatest_m:
        return
    what = short(below) if below else "the floor"
    message = (
        f"nothing supports what is put at {short(individual)}: {what} is {gap_m:.2f} m below it, and the greatest "
        f"thing to handle here is {greatest_m:.2f} m long"
    )
    cure = f"put it at most {greatest_m:.2f} m over what holds things there, or give that a size"
    yield SceneViolation(
        individual, placing_fact(state, individual), "no-support", message, cure, severity_of(gap_m - greatest_m)
    )


def _greatest_m(occupants: tuple[Occupant, ...], state: WorldState) -> float:
    """Return the length in m of the greatest thing to handle, at least DROP_M."""
    handled = [each for each in occupants if state.is_a(each.individual, MANIPULATABLE)]
    return max([DROP_M, *(float(np.max(each.high - each.low)) for each in handled)])
