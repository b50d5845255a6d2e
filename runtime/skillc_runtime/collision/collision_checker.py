"""Whether an arm touches anything in a posture, or comes nearer to it than it shall."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import inf
from typing import TypeAlias

import mujoco

from skillc_runtime.collision.collision_model import MOVES, CollisionModel
from skillc_runtime.motion.pose import Array

SLACK_M = 0.001
"""By how much things may come nearer than allowed: what distances are uncertain by."""

Pair: TypeAlias = tuple[int, int]
"""Two geoms of a model."""


@dataclass(frozen=True, slots=True)
class Collision:
    """Two things, by name, the first of the arm, and how far in m they are apart; below 0 they overlap."""

    one: str
    other: str
    distance_m: float

    def __str__(self) -> str:
        met = "would touch" if self.distance_m <= 0 else f"would come within {1e3 * self.distance_m:.0f} mm of"
        return f"{self.one} {met} {self.other}"


class CollisionChecker:
    """Looks at postures of one arm. From what stands around it keeps its clearance; itself it must not touch.

    What overlaps at `home` does so by the shape of the models and is let pass. Counts how often it looked.
    """

    def __init__(self, body: CollisionModel, home: Array) -> None:
        self.model, self.checks = body, 0
        self._data = mujoco.MjData(body.compiled)
        self._data.qpos[body.joints :] = body.fingers
        self._arm, self._contact = self._data.qpos[: body.joints], self._data.contact
        self._moves: list[bool] = (body.compiled.geom_contype == MOVES).tolist()
        self._passed = frozenset(filter(self._within, self.overlapping_pairs(home)))
        self._allowed, self._unsaid = dict[Pair, float](), frozenset[str]()

    def near_pairs(self, q: Array) -> dict[Pair, float]:
        """Return which geoms are nearer to each other than the clearance at joints q (nv,), and how far apart, m."""
        self._arm[:] = q
        mujoco.mj_kinematics(self.model.compiled, self._data)
        mujoco.mj_collision(self.model.compiled, self._data)
        self.checks += 1
        found = dict[Pair, float]()
        if self._data.ncon == 0:
            return found
        for (one, other), distance in zip(self._contact.geom.tolist(), self._contact.dist.tolist(), strict=True):
            found[one, other] = min(distance, found.get((one, other), distance))
        return found

    def overlapping_pairs(self, q: Array) -> frozenset[Pair]:
        """Return which geoms overlap at joints q (nv,), however near the others are."""
        return frozenset(pair for pair, far in self.near_pairs(q).items() if far <= 0)

    def allow(self, start: Array, goal: Array) -> None:
        """From now on let things be as near as they are where a motion starts and, short of touching, where it ends.

        What overlaps at the start may overlap twice as much on the way out. By more than the clearance nothing can
        really overlap: what is believed of such a thing tells nothing, so it is not asked about.
        """
        begin = {
            pair: max(far - SLACK_M, 0.0) if far > 0 else 2 * far - SLACK_M
            for pair, far in self.near_pairs(start).items()
        }
        end = {pair: max(far - SLACK_M, 0.0) for pair, far in self.near_pairs(goal).items()}
        deep = [pair for pair, far in begin.items() if far < -2 * self.model.margin and not self._within(pair)]
        self._unsaid = frozenset(self._thing(pair) for pair in deep)
        self._allowed = {
            pair: min(self._least(pair), begin.get(pair, inf), end.get(pair, inf)) for pair in {**begin, **end}
        }

    def find_collision(self, q: Array) -> Collision | None:
        """Return the worst that is not allowed at joints q (nv,), None when all is well."""
        wrong = [
            (far, pair)
            for pair, far in self.near_pairs(q).items()
            if far < self._allowed.get(pair, self._least(pair)) and self._counts(pair)
        ]
        if not wrong:
            return None
        distance, (one, other) = min(wrong)
        if not self._moves[one]:
            one, other = other, one
        return Collision(self.model.names[one], self.model.names[other], distance)

    def first_collision(self, way: Iterable[Array]) -> Collision | None:
        """Return what is touched first along postures (nv,) on a way, None when nothing is."""
        return next((touch for q in way if (touch := self.find_collision(q)) is not None), None)

    def worst_collision(self, way: Iterable[Array]) -> Collision | None:
        """Return what comes nearest of all that is touched along postures (nv,) on a way, None when nothing is."""
        touches = (touch for q in way if (touch := self.find_collision(q)) is not None)
        return min(touches, key=lambda touch: touch.distance_m, default=None)

    def _within(self, pair: Pair) -> bool:
        """Whether both belong to the arm, its hand or what that holds."""
        return self._moves[pair[0]] and self._moves[pair[1]]

    def _thing(self, pair: Pair) -> str:
        """Return the name of what stands around, of the two."""
        return self.model.names[pair[1] if self._moves[pair[0]] else pair[0]]

    def _counts(self, pair: Pair) -> bool:
        """Whether it matters that two geoms are near each other."""
        return pair not in self._passed and (self._within(pair) or self._thing(pair) not in self._unsaid)

    def _least(self, pair: Pair) -> float:
        return 0.0 if self._within(pair) else max(self.model.margin - SLACK_M, 0.0)
