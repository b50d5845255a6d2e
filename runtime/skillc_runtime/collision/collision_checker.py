"""Checks whether an arm in a posture collides with anything, or comes closer than its clearance."""

from __future__ import annotations

from collections.abc import Iterable
from math import inf
from typing import TypeAlias

import msgspec
import mujoco
import numpy as np

from skillc_runtime.collision.collision_model import MOVES, CollisionModel
from skillc_runtime.collision.free_motion import make_find_advance, read_part_motions
from skillc_runtime.motion.pose import Array

SLACK_M = 0.001
"""Tolerance of distances: their uncertainty."""

MIN_STEP_M = 0.01
"""Motion of the arm between two checks if its clearance is smaller."""

Pair: TypeAlias = tuple[int, int]
"""Two geoms of a model."""


class Collision(msgspec.Struct, frozen=True):
    """Two parts by name, the first one of the arm, and their distance in m, below 0 if they overlap."""

    one: str
    other: str
    distance_m: float

    def __str__(self) -> str:
        met = "would touch" if self.distance_m <= 0 else f"would come within {1e3 * self.distance_m:.0f} mm of"
        return f"{self.one} {met} {self.other}"


class CollisionChecker:
    """Checks postures (nv,) in rad of one arm: it keeps its clearance from the scenery and must not touch itself.

    Pairs of its own parts that overlap at `home` are ignored: it is due to the models. `checks` counts the checks.
    """

    def __init__(self, body: CollisionModel, home: Array) -> None:
        self.model, self.checks = body, 0
        self._data = mujoco.MjData(body.compiled)
        self._data.qpos[body.joints :] = body.fingers
        self._arm, self._contact = self._data.qpos[: body.joints], self._data.contact
        self._moves: list[bool] = (body.compiled.geom_contype == MOVES).tolist()
        self._find_advance = make_find_advance(read_part_motions(body, max(body.margin, MIN_STEP_M)))
        self._usual = self._least = self._usual_distances()
        self._touching_at_home = frozenset(filter(self._within, self.overlapping_pairs(home)))
        for pair in self._touching_at_home:
            self._allow_distance(pair, -inf)

    def near_pairs(self, q: Array) -> dict[Pair, float]:
        """Return the pairs of geoms that are near each other at joints q (nv,), with their distances in m."""
        found = dict[Pair, float]()
        self._look(q)
        if self._data.ncon == 0:
            return found
        for (one, other), distance in zip(self._contact.geom.tolist(), self._contact.dist.tolist(), strict=True):
            found[one, other] = min(distance, found.get((one, other), distance))
        return found

    def overlapping_pairs(self, q: Array, unsure_m: float = 0.0) -> frozenset[Pair]:
        """Return the pairs of geoms that overlap at joints q (nv,), or may, if the scenery may be `unsure_m` nearer."""
        near = self.near_pairs(q).items()
        return frozenset(pair for pair, far in near if far <= (0.0 if self._within(pair) else unsure_m))

    def deepest_overlap(self, q: Array) -> Collision | None:
        """Return the deepest overlap of the arm, its hand or what it holds with the scenery at joints q (nv,)."""
        found = [(far, pair) for pair, far in self.near_pairs(q).items() if far <= 0 and not self._within(pair)]
        return self._collision(*min(found)) if found else None

    def allow(self, start: Array, goal: Array) -> None:
        """From now on allow distances as small as at the start of a motion and, without contact, at its end.

        Pairs that overlap at the start may overlap twice as much on the way out. An overlap deeper than the clearance
        cannot be real, so the pose of such an obstacle is wrong and it is ignored. start, goal (nv,): rad.
        """
        begin, end = self.near_pairs(start), self.near_pairs(goal)
        deep = [pair for pair, far in begin.items() if far < SLACK_M / 2 - self.model.margin and not self._within(pair)]
        wrong, self._least = {self._obstacle(pair) for pair in deep}, self._usual.copy()
        for pair, far in begin.items():
            self._allow_distance(pair, max(far - SLACK_M, 0.0) if far > 0 else 2 * far - SLACK_M)
        for pair, far in end.items():
            self._allow_distance(pair, max(far - SLACK_M, 0.0))
        for geom, name in enumerate(self.model.names):
            if not self._moves[geom] and name in wrong:
                self._least[geom, :] = self._least[:, geom] = -inf

    def find_collision(self, q: Array) -> Collision | None:
        """Return the worst collision at joints q (nv,), None if there is none."""
        wrong = [(far, pair) for pair, far in self.near_pairs(q).items() if far < self._least[pair]]
        return self._collision(*min(wrong)) if wrong else None

    def find_free_share(self, start: Array, goal: Array) -> float:
        """Return which share of the straight way from a posture that is free to another is free: 1 for all.

        0 if less than half is: the middle is looked at first. start, goal (nv,): rad.
        """
        change, share, before = goal - start, 0.0, 0.0
        if self._look_ahead(start, 0.5, change) < 0.0:
            return 0.0
        while (ahead := self._look_ahead(start, share, change)) >= 0.0:
            if share == 1.0:
                return 1.0
            before, share = share, min(1.0, share + ahead)
        return before if before >= 0.5 else 0.0

    def _look_ahead(self, start: Array, share: float, change: Array) -> float:
        """Return how much farther on a way from a posture an arm may be looked at next, as shares; below 0 for a
        collision here."""
        self._look(start + share * change)
        return self._find_advance(self._least, self._data, change)

    def find_overlap(self, start: Array, way: Iterable[Array], spared: frozenset[str]) -> Collision | None:
        """Return the first overlap of links or the palm along postures (nv,), None if there is none.

        Fingers and what they hold may touch anything, the palm the things with the names `spared`; what overlaps at the
        posture `start` (nv,) may do so on the way: two parts of the arm, and others no deeper.
        """
        begin = {pair: far for pair, far in self.near_pairs(start).items() if far <= 0.0}
        allowed = frozenset(filter(self._within, begin)) | self._touching_at_home
        for q in way:
            for pair, far in self.near_pairs(q).items():
                is_deeper = far < begin.get(pair, 0.0) - SLACK_M
                if is_deeper and pair not in allowed and self._is_unwanted(pair, spared):
                    return self._collision(far, pair)
        return None

    def _collision(self, distance_m: float, pair: Pair) -> Collision:
        """Return the collision of a pair, the part that moves first."""
        one, other = pair if self._moves[pair[0]] else pair[::-1]
        return Collision(self.model.names[one], self.model.names[other], distance_m)

    def _is_unwanted(self, pair: Pair, spared: frozenset[str]) -> bool:
        """Whether no skill wants two parts to touch."""
        one, other = pair if self._moves[pair[0]] else pair[::-1]
        if other in self.model.links or one in self.model.links:
            return True
        return one in self.model.palm and self.model.names[other] not in spared

    def _within(self, pair: Pair) -> bool:
        """Whether both geoms belong to the arm, its hand or held objects."""
        return self._moves[pair[0]] and self._moves[pair[1]]

    def _obstacle(self, pair: Pair) -> str:
        """Return the name of the obstacle of a pair."""
        return self.model.names[pair[1] if self._moves[pair[0]] else pair[0]]

    def _look(self, q: Array) -> None:
        """Find the contacts at joints q (nv,)."""
        self._arm[:] = q
        mujoco.mj_kinematics(self.model.compiled, self._data)
        mujoco.mj_collision(self.model.compiled, self._data)
        self.checks += 1

    def _usual_distances(self) -> Array:
        """Return how close in m each pair of geoms may be, (geoms, geoms)."""
        moves = np.array(self._moves)
        return np.where(np.outer(moves, moves), 0.0, max(self.model.margin - SLACK_M, 0.0))

    def _allow_distance(self, pair: Pair, distance_m: float) -> None:
        """Let a pair of geoms be as close as that from now on."""
        self._least[pair] = self._least[pair[::-1]] = min(self._least[pair], distance_m)
