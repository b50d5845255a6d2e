"""Checks that the poses to grasp, approach and place things are not inside something, and that places have support."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

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
    PLACING_POSE,
)
from skillc_runtime.world.state.world_state import WorldState

LOWERED_M: Final = 0.02
"""How far below its placing pose a thing may come to stand when it is put down: nothing is let go in the air."""


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
    """Yield a placing pose under which nothing holds what is put there."""
    x, y, z = point.tolist()
    boxes = [(box, each.individual) for each in occupants for box in each.boxes]
    tops = [(top, individual) for box, individual in boxes if (top := box.height_at(x, y)) is not None]
    height, below = max(((top, one) for top, one in tops if top <= z + ROUNDED_M), default=(0.0, ""))
    gap_m, short = z - height, state.vocabulary.short
    if gap_m <= LOWERED_M:
        return
    what = short(below) if below else "the floor"
    message = f"nothing supports what is put at {short(individual)}: {what} is {1e3 * gap_m:.0f} mm below it"
    cure = f"lower it by {1e3 * gap_m:.0f} mm, or give what holds things there its true place and size"
    owners = tuple(sorted(state.subjects(HAS_A, individual)))
    yield SceneViolation(
        individual, placing_fact(state, individual), "no-support", message, cure, severity_of(gap_m), owners
    )
