"""Feels by the friction of a tool that slides on a surface where the surface is dirty."""

from __future__ import annotations

from collections.abc import Sequence
from math import erf, sqrt
from typing import TYPE_CHECKING

import msgspec
import numpy as np

from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.dirt_map import CLEAN, DIRTY, SPARED, UNSEEN, DirtMap, format_dirt_map
from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.world.space.frames import pose, size
from skillc_runtime.world.space.surfaces import dirt_friction, least_force_n, surface_layout
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import CLEAN_THRESHOLD, COVERAGE, DIRT_MAP

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell

LEAST_SPEED = 0.03
"""Speed of the tool in m/s from which it slides."""

BEGIN_S = 0.25
"""What a tool that begins to slide feels for so long is how its soft face yields, not friction."""

OVER_S = 0.2
"""The friction of a sample is the mean over so long before it."""

DIRTY_AMOUNT = 0.1
"""The amount of dirt, from 0 to 1, from which it is felt."""

REST_S = 1.0
"""A tool that has not slid for so long has come to rest."""

CLEAN_S = 2.0
"""The friction of the clean surface is the mean over the last so many seconds of the rubbing."""

STEADY = 0.02
"""Share by which it may differ from that of so many seconds before."""


class Touch(msgspec.Struct, frozen=True):
    """One measurement of a sliding tool: time in s, force in N along and against the surface, place and turn of it."""

    now: float
    drag_n: float
    pressed_n: float
    position: Array
    rotation: Array


class Slid:
    """The friction of a tool that slid, from touches in the order of their times (n,) in s."""

    def __init__(self, touches: Sequence[Touch]) -> None:
        self.times = np.array([each.now for each in touches])
        forces = [(each.drag_n, each.pressed_n) for each in touches]
        self._sums = np.concatenate([np.zeros((1, 2)), np.cumsum(forces, axis=0)])

    def find_friction(self, since: Array, until: Array) -> Array:
        """Return the mean friction (n,), unitless, between times (n,) in s; NaN where nothing slid."""
        first, last = np.searchsorted(self.times, since), np.searchsorted(self.times, until, side="right")
        drag, pressed = (self._sums[last] - self._sums[first]).T
        return np.asarray(np.divide(drag, pressed, out=np.full(drag.shape, np.nan), where=pressed > 0.0))


class FeelDirt(Primitive):
    """Feels, until a tool that slides on a surface has come to rest, where the surface is dirty.

    It writes the map and the share of the clean cells, from which the world model judges whether it is clean.
    At first the tool is rubbed on one place for `rub` s, which is clean then: the friction in the end is that
    of the clean surface, u. Where the tool slides with friction v later, the mean amount of dirt under it is
    (1 - v / u) / (1 - s), where s is the share of u with which dirt rubs. A cell is dirty if the mean of that, over the
    time in which the tool lay on it, is at least `DIRTY_AMOUNT`: what lies around a spot counts as dirty too.

    SkillFailure if the arm measures no force, or if dirt rubs as the surface does.
    """

    moves = NOTHING
    stays_put = True

    def __init__(self, cell: Cell, *, arm: str, surface: str, tool: str, rub: float) -> None:
        super().__init__(cell)
        self.arm, self._surface, self._rub = cell.arm(arm), surface, rub
        state = cell.world.snapshot()
        self._least_n, self._share = least_force_n(state, surface), dirt_friction(state, surface)
        self._tool = np.array(size(state, tool)[:2])
        self._touches: list[Touch] = []
        self._start = self._stood_at = 0.0
        """When the feeling began, and when the tool did not slide last, s."""

    def start(self) -> None:
        """Begin; SkillFailure if nothing can be felt."""
        state = self.cell.world.snapshot()
        short = state.vocabulary.short(self._surface)
        if not isinstance(state.value(self._surface, CLEAN_THRESHOLD), float):
            raise SkillFailure(f"the world model has no wiping:cleanThreshold for {short}")
        if self._share == 1.0:
            why = f"the world model has no skillc:dirtFriction below 1 for {short}"
            raise SkillFailure(f"dirt on {short} cannot be felt: {why}")
        if self.arm.measured.felt is None:
            raise SkillFailure(f"dirt on {short} cannot be felt: the arm measures neither forces nor torques")
        self._start = self._stood_at = self.cell.now

    def tick(self) -> Status:
        """Measure once, and write the map at the end; SkillFailure if it is not known how the clean surface feels."""
        now, measured = self.cell.now, self.arm.measured
        force, at = measured.felt, measured.pose
        if force is None:
            raise SkillFailure("the arm does not measure forces or torques any more")
        normal = at.rotation[:, 2]
        speed, drag_n = (_length_across(each[:3], normal) for each in (measured.velocity, force))
        pressed_n = -float(force[:3] @ normal)
        if speed < LEAST_SPEED or pressed_n < self._least_n:
            self._stood_at = now
        elif now - self._stood_at >= BEGIN_S:
            self._touches.append(Touch(now, drag_n, pressed_n, at.position.copy(), at.rotation.copy()))
        rests = bool(self._touches) and now - self._touches[-1].now > REST_S
        if not rests or now - self._start < self._rub:
            return Status.RUNNING
        self._write()
        return Status.SUCCESS

    def _write(self) -> None:
        """Write the map, and the share of the clean cells."""
        slid, end = Slid(self._touches), self._start + self._rub
        clean = self._find_clean(slid, end)
        rubbed = np.arange(end - CLEAN_S, end - OVER_S / 2, OVER_S)
        of_dirt = clean * (1.0 - self._share)
        spread = max(float(np.nanstd(slid.find_friction(rubbed, rubbed + OVER_S))) / of_dirt, 1e-3)
        amounts = (clean - slid.find_friction(slid.times - OVER_S, slid.times)) / of_dirt
        dirt = self._draw_map(amounts[slid.times >= end], spread)
        changes = [SetProperty(self._surface, COVERAGE, dirt.clean_share)]
        changes.append(SetProperty(self._surface, DIRT_MAP, format_dirt_map(dirt)))
        self.cell.world.commit(changes, "FeelDirt", "sensed")

    def _find_clean(self, slid: Slid, end: float) -> float:
        """Return the friction of the clean surface, where the rubbing ended at a time in s; SkillFailure if not."""
        ends = np.array([end - CLEAN_S, end])
        before, clean = slid.find_friction(ends - CLEAN_S, ends)
        if not abs(clean - before) <= STEADY * clean:
            short = self.cell.world.snapshot().vocabulary.short(self._surface)
            raise SkillFailure(
                f"it is not known how the clean {short} feels: where the tool rubbed, the friction was {before:.3f}, "
                f"and {clean:.3f} {CLEAN_S:g} s later"
            )
        return float(clean)

    def _draw_map(self, amounts: Array, spread: float) -> DirtMap:
        """Return the map that follows from the amounts (n,) under the tool in the last touches, with their error."""
        state = self.cell.world.snapshot()
        cells = CoverageMap(pose(state, self._surface), surface_layout(state, self._surface), self._least_n)
        total, count = np.zeros(cells.dose.shape), np.zeros(cells.dose.shape)
        for touch, amount in zip(self._touches[-amounts.size :], amounts, strict=True):
            under = cells.find_under(touch.position, touch.rotation, self._tool)
            total[under] += amount
            count[under] += 1
        felt, mean = count > 0, total / np.maximum(count, 1)
        judged = np.where(felt, np.where(mean < DIRTY_AMOUNT, CLEAN, DIRTY), UNSEEN).astype(np.uint8)
        judged[~cells.mask] = SPARED
        away = np.where(felt, np.abs(mean - DIRTY_AMOUNT), 0.0) / spread
        sure = np.where(felt, np.floor(10.0 * _find_chance(away)), 0).astype(np.uint8)
        return DirtMap(cells.x.size, cells.y.size, judged.tobytes(), sure.tobytes())


def _length_across(vector: Array, normal: Array) -> float:
    """Return the length of what a vector (3,) has in the plane with a normal (3,)."""
    return float(np.linalg.norm(vector - float(vector @ normal) * normal))


def _find_chance(away: Array) -> Array:
    """Return how likely normal noise does not turn verdicts that are so many standard deviations (m, n) away."""
    return np.array([0.5 * (1.0 + erf(each / sqrt(2.0))) for each in away.flat]).reshape(away.shape)
