"""Looks for motions of an arm that are free of collisions: all arguments and results are values, to be copied.

It may take seconds, and ends after a number of looks, so that a motion does not depend on the machine.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import Protocol

import msgspec
import numpy as np

from skillc_runtime.collision.arm_assembly import ArmAssembly
from skillc_runtime.collision.collision_checker import Collision, CollisionChecker
from skillc_runtime.collision.collision_model import build_collision_model
from skillc_runtime.collision.path_planning import JointSpace, NoPath, find_motion_collision, plan_joint_path
from skillc_runtime.collision.scenery import Numbers, Scenery, SolidObstacle
from skillc_runtime.devices.motion_interface import Infeasible, MotionModel, ToolMotion
from skillc_runtime.motion.paths.joint import JointTrajectory
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.reference import Trajectory

BLEND_SHARES = (1.0, 0.5, 0.25)
"""Shares of each corner that are blended, in the order in which they are tried."""


class Surroundings(msgspec.Struct, frozen=True):
    """An arm with what it holds, the scenery, the arm's posture (nv,) `home` in rad, and the parts of other arms."""

    assembly: ArmAssembly
    scenery: Scenery
    home: Numbers
    arms: tuple[SolidObstacle, ...] = ()

    @property
    def obstacles(self) -> tuple[Scenery, tuple[SolidObstacle, ...]]:
        """The scenery, and what the hand holds."""
        return self.scenery, self.assembly.hand.held if self.assembly.hand is not None else ()

    def make_checker(self) -> CollisionChecker:
        """Return a checker; the model of equal surroundings is built once in a process."""
        return CollisionChecker(
            build_collision_model(self.assembly, self.scenery.with_blocks(self.arms)), np.array(self.home)
        )


class JointGoals(Protocol):
    """Postures that are all as good."""

    def find(self, model: MotionModel) -> Iterator[Array]:
        """Yield them, (nv,) in rad, the best first."""
        ...


def find_joint_motion(
    around: Surroundings | None, model: MotionModel, goals: JointGoals, space: JointSpace, pace: float
) -> JointTrajectory | NoPath | Infeasible | None:
    """Return a motion to the first goal that can be reached without a collision, or what is in the way; None for none.

    `around` is None if nothing is known of what is there. `pace` is the share of the maximum joint speeds.
    """
    postures = goals.find(model)
    if (first := next(postures, None)) is None:
        return None
    try:
        if around is None:
            return model.joint_motion((first,), pace)
        contacts = around.make_checker()
        way = plan_joint_path(contacts, model.start, chain((first,), postures), space)
        return _find_blended(contacts, model, way, pace) or model.joint_motion(way, pace)
    except (NoPath, Infeasible) as why:
        return why


def find_tool_motion(
    around: Surroundings | None, model: MotionModel, trajectory: Trajectory, spared: frozenset[str]
) -> ToolMotion | Collision | Infeasible:
    """Return the motion along a trajectory in the world, or which link or palm would overlap what.

    The palm may overlap the things with the names `spared`. `around` is None if nothing is known of what is there.
    """
    try:
        motion = model.tool_motion(trajectory)
    except Infeasible as why:
        return why
    touch = None if around is None else around.make_checker().find_overlap(motion.start, motion.joints, spared)
    return motion if touch is None else touch


def _find_blended(
    contacts: CollisionChecker, model: MotionModel, way: tuple[Array, ...], pace: float
) -> JointTrajectory | None:
    """Return a motion through the postures (nv,) of a path whose corners are blended as far as possible.

    None if there is none; the arm may then stop at each posture of the path, which is free of collisions.
    """
    if len(way) == 1:
        return None
    motions = (model.joint_motion(way, pace, blend) for blend in BLEND_SHARES)
    return next((motion for motion in motions if find_motion_collision(contacts, motion) is None), None)
