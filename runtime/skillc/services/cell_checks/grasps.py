"""Checks that some gripper in the cell is wide and strong enough for each thing to handle."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from skillc.services.cell_checks.facts import ROUNDED_M
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.bodies import read_body
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.grasps import LEAST_CLEARANCE_M, weight_problem
from skillc_runtime.world.space.occupants import Occupant
from skillc_runtime.world.space.shapes import Bin
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import END_EFFECTOR, GRASP_WIDTH, MANIPULATABLE, SIZE, WEIGHT
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class GripperLimits:
    """A gripper: how far it opens in m and how hard it presses in N."""

    gripper: str
    opening_m: float
    force_n: float


def check_grasps(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield things to handle that no gripper can hold however it grasps them; none if a gripper is not known."""
    try:
        grips = [_read_grip(state, each) for each in sorted(state.instances(END_EFFECTOR))]
    except SheetError:
        return
    if not grips:
        return
    widest, strongest = max(grips, key=lambda each: each.opening_m), max(grips, key=lambda each: each.force_n)
    for each in occupants:
        if state.is_a(each.individual, MANIPULATABLE):
            yield from _too_wide(state, each.individual, widest)
            yield from _too_heavy(state, each.individual, strongest.gripper)


def _read_grip(state: WorldState, gripper: str) -> GripperLimits:
    sheet = sheet_of(state, gripper)
    return GripperLimits(gripper, sheet.number("maxOpening"), sheet.number("maxForce"))


def _too_wide(state: WorldState, thing: str, grip: GripperLimits) -> Iterator[SceneViolation]:
    short, stated = state.vocabulary.short, state.value(thing, GRASP_WIDTH)
    width_m = float(stated) if isinstance(stated, int | float) else _narrowest(state, thing)
    if width_m is None or width_m <= grip.opening_m - LEAST_CLEARANCE_M + ROUNDED_M:
        return
    what = "{:.0f} mm wide where it is held" if stated else "nowhere less than {:.0f} mm wide"
    message = f"{short(thing)} is {what.format(1e3 * width_m)}, and {short(grip.gripper)} opens to "
    message += f"{1e3 * grip.opening_m:.0f} mm, {1e3 * LEAST_CLEARANCE_M:.0f} mm of which it needs beside a thing"
    cure = "use a wider gripper, or write where it is narrower, `skillc:graspWidth NUMBER-IN-m`"
    yield SceneViolation(thing, GRASP_WIDTH if stated else SIZE[0], "too-wide", message, cure, "warning")


def _narrowest(state: WorldState, thing: str) -> float | None:
    """Return the least width in m of a thing between two fingers; None without a body, or with walls to hold."""
    try:
        body = read_body(state, thing)
    except (SheetError, FrameError):
        return None
    return None if body is None or isinstance(body.shape, Bin) else float(body.size.min())


def _too_heavy(state: WorldState, thing: str, gripper: str) -> Iterator[SceneViolation]:
    """Yield a thing that slides out of the fingers of the strongest gripper."""
    try:
        problem = weight_problem(state, thing, gripper)
    except (SheetError, FrameError):
        return
    if problem is None:
        return
    short, stated = state.vocabulary.short, state.value(thing, WEIGHT) is not None
    cure = "use a stronger gripper" if stated else f"write its `{short(WEIGHT)}`, which follows from its size else"
    yield SceneViolation(thing, WEIGHT if stated else None, "too-heavy", problem, cure, "warning")
