"""Where an arm starts: somewhere near its home, where it touches nothing that is believed to be there."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.backends.mujoco.rng import rng_for
from skillc_runtime.backends.mujoco.scene_spec import ArmSpec
from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.collision_checker import CollisionChecker
from skillc_runtime.collision.collision_model import build_collision_model
from skillc_runtime.collision.scenery import read_scenery
from skillc_runtime.motion.pose import Array

MOST_DRAWS = 100
"""So often a start is drawn at most until nothing is touched; otherwise the arm starts at home."""


def draw_start(arm: ArmSpec, seed: int) -> tuple[float, ...]:
    """Draw how far each joint is from its home, rad: the first draw that touches no more than the arm does at home."""
    if arm.posture_range_rad == 0:
        return (0.0,) * arm.home.size
    draws = _draws(arm, seed)
    try:
        contacts = _contacts(arm)
    except ValueError:
        # Models that cannot be used are told when the cell is built of them.
        return tuple(next(draws).tolist())
    at_home = contacts.overlapping_pairs(arm.home)
    free = (off for off in draws if contacts.overlapping_pairs(arm.home + off) <= at_home)
    return tuple(next(free, 0.0 * arm.home).tolist())


def _draws(arm: ArmSpec, seed: int) -> Iterator[Array]:
    rng = rng_for(arm.individual, seed)
    for _ in range(MOST_DRAWS):
        yield rng.uniform(-1.0, 1.0, arm.home.size) * arm.posture_range_rad


def _contacts(arm: ArmSpec) -> CollisionChecker:
    state, gripper = arm.sheet.state, arm.gripper
    openings = {} if gripper is None else {gripper.individual: gripper.first_opening_m}
    return CollisionChecker(
        build_collision_model(read_arm_assembly(state, arm.individual, openings), read_scenery(state, arm.base)),
        arm.home,
    )
