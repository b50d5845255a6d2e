"""Moves an arm around the obstacles in the world model, or its tool along a path on which only the tool may touch any.

Other arms that stand still are obstacles, too; plans keep those apart that move at the same time. The motion is looked
for beside the ticks, while the arm holds; again if the arm, or what is around it, was moved.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np

from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.arm_parts import read_other_arms
from skillc_runtime.collision.collision_checker import Collision
from skillc_runtime.collision.motion_search import JointGoals, Surroundings, find_joint_motion, find_tool_motion
from skillc_runtime.collision.path_planning import JointSpace, NoPath
from skillc_runtime.collision.scenery import read_scenery
from skillc_runtime.devices.motion_interface import Infeasible
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Trajectory
from skillc_runtime.primitives.arm_motion import raise_fault
from skillc_runtime.primitives.computation import Computation, Computing
from skillc_runtime.primitives.primitive import SkillFailure, SpaceLacking
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import ARM_DEVICE, HAS_GRIPPER, MANIPULATABLE

if TYPE_CHECKING:
    from skillc_runtime.devices.arm_driver import ArmDriver
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.world.state.world_state import WorldState

MAX_SEARCHES = 5
"""How often a motion is looked for because the arm, or what is around it, was moved meanwhile."""

SETTLING_TICKS = 150
"""For how many ticks at most an arm that still settles is waited for before a motion is looked for again."""

SAME_M, SAME_RAD = 5e-4, 5e-4
"""How far from where a motion was to start an arm may be and still follow it."""

STANDING_RAD = 0.01
"""An arm whose joints are all nearer than this to where they were stands where it stood."""

LIMIT_S = 120.0
"""How long a search may take, in s of wall time, on a machine that does much else: it ends after so many looks."""


def move_collision_free(
    cell: Cell, arm: str, goals: JointGoals, pace: float, unreachable: SpaceLacking
) -> Generator[Computation | None, Any, Array]:
    """Move the joints to the first of the goals that can be reached without a collision; return it, (nv,) in rad.

    `pace` is the share of the maximum joint speeds. SkillFailure, before anything moves, says what is in the way;
    `unreachable` if there are no goals.
    """
    driver = _come_to_rest(cell, arm)
    for _ in range(MAX_SEARCHES):
        seen, model = _look_around(cell, arm), driver.motion.model()
        arguments = (seen.around, model, goals, seen.find_space(driver), pace)
        found = yield Computation(find_joint_motion, arguments, LIMIT_S, "the search for a path")
        if found is None:
            raise unreachable
        if isinstance(found, NoPath):
            raise SpaceLacking(str(found))
        if isinstance(found, Infeasible):
            raise found
        raise_fault(driver)
        if np.abs(driver.motion.stopping_joints() - model.start).max() < SAME_RAD and seen.is_current(cell):
            driver.motion.follow_joints(found)
            return np.asarray(found.end)
        yield from _wait_until_still(driver)
    raise _restless()


def move_tool_along(cell: Cell, arm: str, make: Callable[[], Trajectory]) -> Computing:
    """Move the tool along a trajectory in the world, on which it may touch things, but no link and no palm.

    `make` returns the trajectory from the stopping pose. SkillFailure, before anything moves, says which part would be
    in the way of what; Infeasible if the arm cannot follow. The palm may touch movable things.
    """
    driver = _come_to_rest(cell, arm)
    for _ in range(MAX_SEARCHES):
        trajectory, seen = make(), _look_around(cell, arm)
        arguments = (seen.around, driver.motion.model(), trajectory, seen.movable)
        found = yield Computation(find_tool_motion, arguments, LIMIT_S, "the look at the way of the tool")
        if isinstance(found, Collision):
            raise SpaceLacking(f"on the way of the tool {found} and overlap it by {-1e3 * found.distance_m:.0f} mm")
        if isinstance(found, Infeasible):
            raise found
        raise_fault(driver)
        if _is_same(trajectory.at(0.0).pose, driver.motion.stopping_pose()) and seen.is_current(cell):
            driver.motion.follow_tool(found)
            return
        yield from _wait_until_still(driver)
    raise _restless()


class _Seen(msgspec.Struct, frozen=True):
    """What was around an arm in a version of the world; `around` is None if a model or a pose is missing.

    standing: the joints (nv,) in rad of other arms that stood still.
    """

    state: WorldState
    arm: str
    around: Surroundings | None
    standing: Mapping[str, tuple[float, ...]]

    @property
    def movable(self) -> frozenset[str]:
        """The names of the things that the palm may touch."""
        return frozenset(map(self.state.vocabulary.short, self.state.instances(MANIPULATABLE)))

    def find_space(self, driver: ArmDriver) -> JointSpace:
        """Return where the joints may be, and the postures of the arm's sheet, if it has one."""
        if self.around is None:
            return JointSpace(driver.limits.range, ())
        sheet = sheet_of(self.state, self.arm)
        return JointSpace(driver.limits.range, tuple(sheet.posture(name) for name in sheet.posture_names))

    def is_current(self, cell: Cell) -> bool:
        """Whether nothing around the arm, or in its hand, has changed since; fingers may have moved."""
        if not self._knows(_find_standing(cell, self.state, self.arm)):
            return False
        if cell.world.snapshot() is self.state:
            return True
        now = _look_around(cell, self.arm).around
        if now is None or self.around is None:
            return now is self.around
        return now.obstacles == self.around.obstacles

    def _knows(self, standing: Mapping[str, tuple[float, ...]]) -> bool:
        """Whether arms stand where they stood, as far as they stand now."""
        return all(
            other in self.standing and np.abs(np.subtract(self.standing[other], q)).max() < STANDING_RAD
            for other, q in standing.items()
        )


def _look_around(cell: Cell, arm: str) -> _Seen:
    """Return what an arm can collide with."""
    state = cell.world.snapshot()
    openings = {each: cell.gripper(each).opening_m for each in state.objects(arm, HAS_GRIPPER)}
    standing = _find_standing(cell, state, arm)
    try:
        home, base = tuple(sheet_of(state, arm).posture("home").tolist()), pose(state, arm)
        assembly, scenery = read_arm_assembly(state, arm, openings), read_scenery(state, base)
        others = read_other_arms(state, arm, base, {each: np.array(q) for each, q in standing.items()}, {})
        return _Seen(state, arm, Surroundings(assembly, scenery, home, others), standing)
    except (SheetError, FrameError):
        return _Seen(state, arm, None, standing)


def _find_standing(cell: Cell, state: WorldState, arm: str) -> dict[str, tuple[float, ...]]:
    """Return the joints (nv,) in rad, rounded, of all other arms of the cell that stand still."""
    found = dict[str, tuple[float, ...]]()
    for other in sorted(state.instances(ARM_DEVICE) - {arm}):
        with suppress(KeyError):
            if (q := cell.find_standing_joints(other)) is not None:
                found[other] = tuple(np.round(q, 3).tolist())
    return found


def _come_to_rest(cell: Cell, arm: str) -> ArmDriver:
    """Return the driver of an arm that holds still, or is about to."""
    driver = cell.arm(arm)
    if not driver.motion.done:
        driver.motion.stop()
    return driver


def _wait_until_still(driver: ArmDriver) -> Computing:
    for _ in range(SETTLING_TICKS):
        if driver.measured.still:
            return
        yield None


def _is_same(one: Pose, other: Pose) -> bool:
    far, turned = np.abs(one.position - other.position).max(), np.abs(one.rotation - other.rotation).max()
    return bool(far < SAME_M and turned < SAME_RAD)


def _restless() -> SkillFailure:
    return SkillFailure(f"the arm, or what is around it, was moved {MAX_SEARCHES} times while its way was looked for")
