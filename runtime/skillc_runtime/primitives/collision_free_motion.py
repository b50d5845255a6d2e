"""Moves the joints of an arm to a posture around the obstacles in the world model."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from typing import TYPE_CHECKING

from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.collision_checker import CollisionChecker
from skillc_runtime.collision.collision_model import build_collision_model
from skillc_runtime.collision.path_planning import JointSpace, NoPath, find_motion_collision, plan_joint_path
from skillc_runtime.collision.scenery import read_scenery
from skillc_runtime.motion.joint import JointTrajectory
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.reference import Trajectory
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import HAS_GRIPPER, MANIPULATABLE

if TYPE_CHECKING:
    from skillc_runtime.devices.arm_driver import ArmDriver
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.world.state.world_state import WorldState

BLEND_SHARES = (1.0, 0.5, 0.25)
"""Shares of each corner that are blended, in the order in which they are tried."""


def move_collision_free(cell: Cell, arm: str, goals: Iterable[Array], pace: float) -> None:
    """Move the joints to the first of the postures (nv,) in rad that can be reached without a collision.

    `pace` is the share of the maximum joint speeds. SkillFailure, before anything moves, says what is in the way.
    """
    driver = cell.arm(arm)
    state = cell.world.snapshot()
    try:
        contacts, known = _make_collision_model(cell, state, arm)
    except (SheetError, FrameError):
        driver.motion.move_joints(next(iter(goals)), pace)
        return
    try:
        driver.motion.follow_joints(_plan_motion(driver, contacts, known, goals, pace))
    except NoPath as why:
        raise SkillFailure(str(why)) from why


def move_tool_along(cell: Cell, arm: str, trajectory: Trajectory) -> None:
    """Move the tool along a trajectory in the world, on which it may touch things, but no link and no palm.

    SkillFailure, before anything moves, says which part would be in the way of what; Infeasible if the arm cannot
    follow. The palm may touch movable things.
    """
    driver, state = cell.arm(arm), cell.world.snapshot()
    with suppress(SheetError, FrameError):
        contacts, _ = _make_collision_model(cell, state, arm)
        movable = frozenset(map(state.vocabulary.short, state.instances(MANIPULATABLE)))
        touch = contacts.find_overlap(*driver.motion.joints_along(trajectory), movable)
        if touch is not None:
            raise SkillFailure(f"on the way of the tool {touch} and overlap it by {-1e3 * touch.distance_m:.0f} mm")
    driver.motion.move_along(trajectory)


def _make_collision_model(cell: Cell, state: WorldState, arm: str) -> tuple[CollisionChecker, JointSpace]:
    """Return what an arm can collide with, and its limits; SheetError without a model, FrameError without a pose."""
    openings = {each: cell.gripper(each).opening_m for each in state.objects(arm, HAS_GRIPPER)}
    shape = build_collision_model(read_arm_assembly(state, arm, openings), read_scenery(state, pose(state, arm)))
    sheet = sheet_of(state, arm)
    contacts = CollisionChecker(shape, sheet.posture("home"))
    return contacts, JointSpace(cell.arm(arm).limits.range, tuple(sheet.posture(name) for name in sheet.posture_names))


def _plan_motion(
    driver: ArmDriver, contacts: CollisionChecker, known: JointSpace, goals: Iterable[Array], pace: float
) -> JointTrajectory:
    """Return a collision-free motion whose corners are blended as far as possible; NoPath if there is no path.

    If no blending is possible the arm stops at each posture of the path, which is free of collisions.
    """
    postures = plan_joint_path(contacts, driver.motion.stopping_joints(), goals, known)
    if len(postures) > 1:
        for blend in BLEND_SHARES:
            motion = driver.motion.joint_motion(postures, pace, blend)
            if find_motion_collision(contacts, motion) is None:
                return motion
    return driver.motion.joint_motion(postures, pace)
