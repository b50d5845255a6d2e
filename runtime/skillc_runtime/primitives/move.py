"""Moving an arm to a pose or a posture."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.path import path
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.primitives.arm_motion import ArmMotion
from skillc_runtime.primitives.joint_way import move_clear
from skillc_runtime.primitives.posture import posture_of
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.state.terms import HAS_POSTURE, HAS_SHEET, POSTURE_NAME

if TYPE_CHECKING:
    from skillc_runtime.robots.cell import Cell

HOME = "home"

SEEDS = 8
"""How many other postures are looked for where the one nearest to home is not free."""


class MoveJoints(ArmMotion):
    """Move the tool to `target` through joint space, with a share `pace` of the joints' greatest speeds.

    Around what the world model knows to be there; what the arm holds moves along.
    """

    def __init__(self, cell: Cell, *, arm: str, target: Pose, pace: float) -> None:
        super().__init__(cell, arm)
        self._individual, self._target, self._pace = arm, target, pace

    def go(self) -> None:
        """Find the posture nearest to home that puts the tool there, another where that one is not free, and go."""
        seed = posture_of(self.cell.world.snapshot(), self._individual, HOME)
        q = self.arm.inverse_kinematics(self._target, seed)
        if q is None:
            place = ", ".join(f"{part:.3f}" for part in self._target.position)
            far = np.linalg.norm(self._target.position - self.arm.pose.position)
            raise SkillFailure(
                f"the arm cannot reach ({place}) m in this orientation, {far:.2f} m from where its tool is"
            )
        move_clear(self.cell, self._individual, chain([q], self._others(seed)), self._pace)

    def _others(self, home: Array) -> Iterator[Array]:
        """Yield other postures that put the tool there: near where the joints are, then all over their range."""
        draw, limits = np.random.default_rng(0), self.arm.limits.range
        low, high = np.maximum(limits[:, 0], home - np.pi), np.minimum(limits[:, 1], home + np.pi)
        for seed in (self.arm.q, *(draw.uniform(low, high) for _ in range(SEEDS))):
            q = self.arm.inverse_kinematics(self._target, seed)
            if q is not None:
                yield q


class TakePosture(ArmMotion):
    """Take a posture of the arm's data sheet, around what the world model knows to be there."""

    text_names = MappingProxyType({"posture": ("arm", HAS_SHEET, HAS_POSTURE, POSTURE_NAME)})

    def __init__(self, cell: Cell, *, arm: str, posture: str, pace: float) -> None:
        super().__init__(cell, arm)
        self._individual, self._posture, self._pace = arm, posture, pace

    def go(self) -> None:
        """Look the posture up and go."""
        q = posture_of(self.cell.world.snapshot(), self._individual, self._posture)
        move_clear(self.cell, self._individual, [q], self._pace)


class MoveLinear(ArmMotion):
    """Move the tool to `target` along a straight line at `speed` m/s, turning on the way."""

    def __init__(self, cell: Cell, *, arm: str, target: Pose, speed: float) -> None:
        super().__init__(cell, arm)
        self._target, self._speed = target, speed

    def go(self) -> None:
        """Plan the line from where the reference rests, and go."""
        limits = self.limits(self._speed)
        self.arm.move_along(path([self.arm.anchor, self._target], limits))
