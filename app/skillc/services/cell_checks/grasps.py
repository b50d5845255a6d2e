"""Checks that some gripper in the cell can grasp each thing to handle as it lies, by the rule that `Pick` follows."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.grasping.grasps import grasp_problem
from skillc_runtime.world.space.grasping.grip_force import GraspError
from skillc_runtime.world.space.occupants import Occupant
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import CAN_GRASP, END_EFFECTOR, GRASP_WIDTH, MANIPULATABLE, SIZE, WEIGHT
from skillc_runtime.world.state.world_state import WorldState


def check_grasps(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield things to handle that no gripper can grasp, and why the widest cannot; none if one is not known."""
    try:
        grippers = sorted(state.instances(END_EFFECTOR), key=lambda each: (-_opening_m(state, each), each))
    except SheetError:
        return
    for thing in (each.individual for each in occupants if state.is_a(each.individual, MANIPULATABLE)):
        try:
            problems = [grasp_problem(state, gripper, thing) for gripper in grippers]
        except (SheetError, FrameError):
            continue
        known = [each for each in problems if each is not None]
        if known and len(known) == len(grippers):
            yield _violation(state, thing, known[0])


def _opening_m(state: WorldState, gripper: str) -> float:
    return sheet_of(state, gripper).number("maxOpening")


def _violation(state: WorldState, thing: str, problem: GraspError) -> SceneViolation:
    """Return a warning, because other tasks may use the thing without holding it."""
    wanted = (WEIGHT,) if problem.name == "too-heavy" else (GRASP_WIDTH, SIZE[0])
    place = next((each for each in wanted if state.value(thing, each) is not None), None)
    return SceneViolation(thing, place, problem.name, problem.problem, problem.cure, "warning", prevents=CAN_GRASP)
