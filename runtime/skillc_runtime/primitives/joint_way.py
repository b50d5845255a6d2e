"""The way of an arm's joints to a posture, clear of what the world model knows to be there."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from skillc_runtime.avoidance.body import body
from skillc_runtime.avoidance.contacts import Contacts
from skillc_runtime.avoidance.outfit import outfit
from skillc_runtime.avoidance.scenery import scenery
from skillc_runtime.avoidance.ways import Known, NoWay, touch_on, way
from skillc_runtime.motion.joint import JointTrajectory
from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import HAS_GRIPPER

if TYPE_CHECKING:
    from skillc_runtime.robots.cell import Cell
    from skillc_runtime.robots.driver import ArmDriver
    from skillc_runtime.world.state.world_state import WorldState

BLENDS = (1.0, 0.5, 0.25)
"""How much of each corner is cut, tried in this order."""


def move_clear(cell: Cell, arm: str, goals: Iterable[Array], pace: float) -> None:
    """Move the joints to the first of some postures (nv,) that can be reached without touching anything that is known.

    SkillFailure, before anything moves, says what is in the way.
    """
    driver = cell.arm(arm)
    state = cell.world.snapshot()
    try:
        contacts, known = _seen(cell, state, arm)
    except (SheetError, FrameError):
        driver.move_joints(next(iter(goals)), pace)
        return
    try:
        driver.follow_joints(_motion(driver, contacts, known, goals, pace))
    except NoWay as why:
        raise SkillFailure(str(why)) from why


def _seen(cell: Cell, state: WorldState, arm: str) -> tuple[Contacts, Known]:
    """Return what an arm can touch; SheetError where it has no model, FrameError where it is nowhere."""
    openings = {each: cell.gripper(each).opening_m for each in state.objects(arm, HAS_GRIPPER)}
    shape = body(outfit(state, arm, openings), scenery(state, pose(state, arm)))
    sheet = sheet_of(state, arm)
    contacts = Contacts(shape, sheet.posture("home"))
    return contacts, Known(cell.arm(arm).limits.range, tuple(sheet.posture(name) for name in sheet.posture_names))


def _motion(
    driver: ArmDriver, contacts: Contacts, known: Known, goals: Iterable[Array], pace: float
) -> JointTrajectory:
    """Return a motion that touches nothing, its corners cut as far as there is room; NoWay where there is none.

    Where there is no room the arm stops at each posture: right on the way, which was looked at when it was found.
    """
    postures = way(contacts, driver.joint_anchor, goals, known)
    if len(postures) > 1:
        for blend in BLENDS:
            motion = driver.joint_motion(postures, pace, blend)
            if touch_on(contacts, motion) is None:
                return motion
    return driver.joint_motion(postures, pace)
