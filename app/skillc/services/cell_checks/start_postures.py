"""Checks that no arm starts inside another thing."""

from __future__ import annotations

from collections.abc import Iterator

from skillc.services.cell_checks.facts import ROUNDED_M
from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.occupants import Occupant
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import ARM_DEVICE, HAS_GRIPPER, HAS_SHEET
from skillc_runtime.world.state.world_state import WorldState

HOME = "home"
"""The posture in which an arm starts."""


def check_start_postures(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield each arm of which a part overlaps another thing at home, by more than numbers in files are rounded."""
    if not occupants:
        return
    for arm in sorted(state.instances(ARM_DEVICE)):
        try:
            found = _deepest_overlap(state, arm)
        except (SheetError, FrameError, ValueError):
            # Missing facts and models that cannot be read are reported by other checks.
            continue
        if found is not None:
            yield _violation(state, arm, *found)


def _deepest_overlap(state: WorldState, arm: str) -> tuple[str, str, float] | None:
    """Return the part of an arm and the thing that overlap most at home, by name, and how deep in m; else None."""
    # The simulator is slow to import.
    from skillc_runtime.collision.collision_checker import CollisionChecker
    from skillc_runtime.collision.collision_model import build_collision_model
    from skillc_runtime.collision.scenery import read_scenery

    home = sheet_of(state, arm).posture(HOME)
    openings = {each: sheet_of(state, each).number("maxOpening") / 2 for each in state.objects(arm, HAS_GRIPPER)}
    model = build_collision_model(read_arm_assembly(state, arm, openings), read_scenery(state, pose(state, arm)))
    if model.joints != home.size:
        return None
    touch = CollisionChecker(model, home).deepest_overlap(home)
    return None if touch is None or -touch.distance_m <= ROUNDED_M else (touch.one, touch.other, -touch.distance_m)


def _violation(state: WorldState, arm: str, part: str, thing: str, depth_m: float) -> SceneViolation:
    short = state.vocabulary.short
    message = f"{part} starts {1e3 * depth_m:.0f} mm inside {thing}: {short(arm)} starts in its posture `{HOME}`"
    cure = f"move one of them, or change the posture in {short(sheet_of(state, arm).individual)}"
    return SceneViolation(arm, HAS_SHEET, "starts-inside", message, cure)
