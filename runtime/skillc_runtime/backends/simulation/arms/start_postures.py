"""Draws the start posture of an arm: near its home and free of collisions with known obstacles."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.collision_checker import CollisionChecker
from skillc_runtime.collision.collision_model import build_collision_model
from skillc_runtime.collision.scenery import read_scenery
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Array

MAX_DRAWS = 100
"""Greatest number of draws; if all collide, the arm starts at home."""


def draw_start(arm: ArmSpec, seed: int, unsure_m: float = 0.0) -> tuple[float, ...]:
    """Draw the offsets of the joints from home in rad: the first draw without more collisions than at home.

    Whatever stands around the arm may be `unsure_m` nearer than it is believed to be.
    """
    if arm.posture_range_rad == 0:
        return (0.0,) * arm.home.size
    draws = _draws(arm, seed)
    try:
        contacts = _contacts(arm, unsure_m)
    except ValueError:
        # Invalid models are reported when the cell is built.
        return tuple(next(draws).tolist())
    at_home = contacts.overlapping_pairs(arm.home, unsure_m)
    free = (off for off in draws if contacts.overlapping_pairs(arm.home + off, unsure_m) <= at_home)
    return tuple(next(free, 0.0 * arm.home).tolist())


def find_overlap(arm: ArmSpec, q: Array) -> str | None:
    """Return what an arm overlaps with in the scene at joints q (nv,) in rad; None for nothing."""
    found = _contacts(arm).deepest_overlap(q)
    return None if found is None else f"{found.one} in {found.other}"


def _draws(arm: ArmSpec, seed: int) -> Iterator[Array]:
    rng = rng_for(arm.individual, seed)
    for _ in range(MAX_DRAWS):
        yield rng.uniform(-1.0, 1.0, arm.home.size) * arm.posture_range_rad


def _contacts(arm: ArmSpec, seen_m: float = 0.0) -> CollisionChecker:
    """Return what checks an arm, and sees up to `seen_m` around it."""
    state, gripper = arm.sheet.state, arm.gripper
    openings = {} if gripper is None else {gripper.individual: gripper.first_opening_m}
    assembly = read_arm_assembly(state, arm.individual, openings)
    if seen_m > assembly.clearance_m:
        assembly = replace(assembly, clearance_m=seen_m)
    return CollisionChecker(build_collision_model(assembly, read_scenery(state, arm.base)), arm.home)
