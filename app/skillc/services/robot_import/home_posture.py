"""Proposes a home posture by inverse kinematics: the tool points down, joints are not at the ends of their ranges."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.control.laws.virtual_arm import VirtualArm, load_virtual_model
from skillc_runtime.kinematics.inverse import find_postures
from skillc_runtime.motion.pose import Array, Pose, exp

AHEAD = (0.5, 0.6)
"""How far in front of the base the flange may be at home, as a share of the reach."""
ABOVE = (0.6, 0.75)
"""How high above the base it may be, likewise: a long hand is above what stands as high as the base."""
TURNS = 4
FAR_RAD = 1.0
"""Joints farther than this from the ends of their ranges are no better than those that are this far."""
SAMPLES = 100
"""Postures in which parts that overlap are counted; those that nearly always do overlap because shapes are simple."""


@dataclass(frozen=True, slots=True, eq=False)
class ArmShape:
    """What an arm is like in its postures.

    reach_m: 85 % of the largest distance of flange and shoulder; shoulder_m: height of the second joint that turns
    above the base, both with joints that slide anywhere in their ranges, or at 0. For a home, these are in the middle:
    `carried` (3,) m is how far that carries the shoulder, `turned_m` is the reach of the other joints from there.
    """

    reach_m: float
    shoulder_m: float
    carried: Array
    turned_m: float


class HomeSearch:
    """The search in the MJCF file of an arm."""

    def __init__(self, mjcf: Path) -> None:
        spec = mujoco.MjSpec.from_file(str(mjcf))
        for geom in spec.geoms:
            geom.contype = geom.conaffinity = 1
        self._model = spec.compile()
        self._data = mujoco.MjData(self._model)
        self._arm = VirtualArm(load_virtual_model(mjcf))
        self._chain = self._arm.read_chain()
        self._limits: Array = self._model.jnt_range.copy()
        self._slides = self._model.jnt_type == mujoco.mjtJoint.mjJNT_SLIDE
        self._second = int(self._model.jnt_bodyid[np.flatnonzero(~self._slides)[1]])
        drawn = np.random.default_rng(2).uniform(self._limits[:, 0], self._limits[:, 1], (20 * SAMPLES, self._model.nv))
        self._usual = self._usual_overlaps(drawn[:SAMPLES])
        self.shape = self._measure(drawn)

    def find(self) -> Array | None:
        """Return the best posture (n,) in rad; None if the arm cannot point its flange down before its base."""
        found = [q for q in self._candidates() if not self._touches_itself(q)]
        return max(found, key=self._score, default=None)

    def _candidates(self) -> Iterator[Array]:
        most = np.where(self._slides, np.inf, np.pi)
        middle = np.clip(self._limits, -most[:, None], most[:, None]).mean(axis=1)
        for ahead, above, turn in product(AHEAD, ABOVE, range(TURNS)):
            down = exp(np.array([0.0, 0.0, 2 * np.pi * turn / TURNS])) @ np.diag([1.0, -1.0, -1.0])
            place = self.shape.carried + self.shape.turned_m * np.array([ahead, 0.0, above])
            yield from find_postures(self._chain, Pose(place, down), self._limits, middle)

    def _score(self, q: Array) -> float:
        """Rate a posture: room to the ends of ranges, dexterity, elbow above the flange, all links above the ground."""
        room = np.minimum(np.minimum(q - self._limits[:, 0], self._limits[:, 1] - q), FAR_RAD).min()
        self._arm.update_kinematics(q)
        J = self._arm.jacobian
        dexterity = np.sqrt(max(np.linalg.det(J @ J.T), 0.0))
        self._move(q)
        links = self._data.xpos[self._second :]
        grounded = float(links[:, 2].min() < 0.02)
        ease = room + dexterity / self.shape.turned_m**3 + self._elbow_height(links)
        return float(ease - 2 * grounded - 0.05 * np.abs(q).sum())

    def _elbow_height(self, links: Array) -> float:
        """Return how far the link that is farthest from the line between shoulder and flange is above it: -1 to 1."""
        shoulder, flange = links[0], self._data.site("flange").xpos
        along = (flange - shoulder) / np.linalg.norm(flange - shoulder)
        away = links - shoulder
        away -= np.outer(away @ along, along)
        farthest = away[np.argmax(np.linalg.norm(away, axis=1))]
        return float(farthest[2] / max(np.linalg.norm(farthest), 1e-9))

    def _measure(self, postures: Array) -> ArmShape:
        zero = np.zeros(self._model.nv)
        shoulder = self._shoulder(np.clip(zero, *self._limits.T))
        above = np.array([0.0, 0.0, shoulder[2]])
        carried = self._shoulder(self._centred(zero)) - self._shoulder(zero)
        reach_m = self._reach(postures, above)
        turned_m = self._reach(self._centred(postures), carried + above) if self._slides.any() else reach_m
        return ArmShape(round(reach_m, 2), round(float(shoulder[2]), 4), carried, round(turned_m, 2))

    def _centred(self, postures: Array) -> Array:
        """Return postures (.., n) with joints that slide in the middle of their ranges."""
        return np.where(self._slides, self._limits.mean(axis=1), postures)

    def _shoulder(self, q: Array) -> Array:
        self._move(q)
        place: Array = self._data.xpos[self._second].copy()
        return place

    def _reach(self, postures: Array, shoulder: Array) -> float:
        """Return 85 % of the largest distance of the flange from a point (3,) m in some postures."""
        far = 0.0
        for q in postures:
            self._move(q)
            far = max(far, float(np.linalg.norm(self._data.site("flange").xpos - shoulder)))
        return 0.85 * far

    def _usual_overlaps(self, postures: Array) -> set[tuple[int, int]]:
        """Return the pairs of bodies that overlap in most postures."""
        seen = [pair for q in postures for pair in self._overlaps(q)]
        return {pair for pair in set(seen) if seen.count(pair) > 0.7 * len(postures)}

    def _touches_itself(self, q: Array) -> bool:
        return bool(self._overlaps(q) - self._usual)

    def _overlaps(self, q: Array) -> set[tuple[int, int]]:
        self._move(q)
        mujoco.mj_collision(self._model, self._data)
        bodies: Any = self._model.geom_bodyid[self._data.contact.geom]
        return {(min(pair), max(pair)) for pair in bodies.tolist()}

    def _move(self, q: Array) -> None:
        self._data.qpos[:] = q
        mujoco.mj_kinematics(self._model, self._data)
