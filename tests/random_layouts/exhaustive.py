"""Searches all ways to put a part into a bin: orders, arms, grasps and places, in MuJoCo, with none of the tested code.

Of each motion the postures at its ends and on the lines of the hand are found, not the path between them: so it finds
more ways than there are.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise, product

import mujoco
import numpy as np

from judged_looks.arm_in_model import ArmInModel, Frame, copy_with_solid_pads, touching_bodies
from random_cells.drawing import TABLE_M, Bin, Part
from random_layouts.drawing import Layout
from random_layouts.stations import BASE_M, TABLE_SIDES_M, Station
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.names import base_body_name
from skillc_runtime.motion.pose import Array, exp

MOST_MOVES = 3
STARTS = 12
"""From how many random postures each posture is searched for."""

APPROACH_M, LINE_M, LIFT_M = 0.10, 0.02, 0.05
SIDEWAYS_LIFT_M = 0.02
"""How far what is grasped from the side is lifted before the hand goes back."""

STANDS, STAND_M, STAND_RAD = 40, 0.45, 0.5
"""How many places of a base at a workstation are tried, and how far from where that wants it, in m and rad."""

FLOOR_M = 0.004
"""How thick the floor of a bin is."""

ROOM_M = 0.008
"""How much farther than a part is wide the fingers open: little, so that they fit."""

FARTHEST_M = 1.2
"""How far from the second joint no arm gets with its hand."""

QUARTERS = tuple(exp(np.array([0.0, 0.0, quarter * np.pi / 2])) for quarter in range(4))
DOWN = np.diag([1.0, -1.0, -1.0])
AHEAD = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""The axes (3, 3) of a hand that points down, its fingers along y, and of one that points along x."""

Poses = Mapping[str, Frame]
"""Where the middles of parts are, and the base at BASE, by name."""

BASE = "Robot-1"


@dataclass(frozen=True, slots=True, eq=False)
class Grasp:
    """Where the hand of an arm takes a part, how far its fingers open in m, and its posture (nv,) in rad there."""

    arm: ArmInModel
    hand: Frame
    opening_m: float
    q: Array


def find_way(cell: SimulatedCell, layout: Layout) -> str | None:
    """Return the moves that put the part of the goal into its bin, as text; None if there are none."""
    return _Search(cell, layout).find()


class _Search:
    def __init__(self, cell: SimulatedCell, layout: Layout) -> None:
        self.model = model = copy_with_solid_pads(cell.model)
        self.data = mujoco.MjData(model)
        self.data.qpos[:] = cell.data.qpos
        self.arms = [ArmInModel(model, self.data, number + 1) for number in range(layout.arms)]
        self.homes = [(each.q_at, cell.data.qpos[each.q_at].copy()) for each in self.arms]
        self.parts = {each.name: each for each in layout.cell.parts}
        self.bins = {each.name: each for each in layout.cell.bins}
        self.goal, self.stations = layout.cell.goal[0], layout.stations
        self.base = int(cell.model.body(base_body_name(f"lab:{BASE}")).mocapid[0]) if layout.stations else -1
        self.rng = np.random.default_rng(0)

    def find(self) -> str | None:
        poses = {name: Frame(np.array(part.at), np.eye(3)) for name, part in self.parts.items()}
        self._place(poses)
        if any(_is_of_robot(pair) for pair in touching_bodies(self.model, self.data)):
            return None
        ways = (self._go(poses, moves) for moves in range(1, MOST_MOVES + 1))
        return next((each for each in ways if each is not None), None)

    def _go(self, poses: Poses, moves: int) -> str | None:
        """Return a way with so many moves."""
        part, bin_ = self.goal
        others = (
            [(part, bin_)] if moves == 1 else [each for each in product(self.parts, self.bins) if each != self.goal]
        )
        for moved, to in others:
            for number, arm in enumerate(self.arms, 1):
                after = self._move(poses, arm, self.parts[moved], self.bins[to])
                if after is None:
                    continue
                step = f"{moved} into {to} with {number}"
                rest = "" if moves == 1 else self._go(after, moves - 1)
                if rest is not None:
                    return f"{step}, {rest}" if rest else step
        return None

    def _move(self, poses: Poses, arm: ArmInModel, part: Part, bin_: Bin) -> Poses | None:
        for there in self._stands(poses, poses[part.name]):
            for grasp in self._grasps(there, arm, part):
                for spot in self._spots(part, bin_):
                    at = next((each for each in self._stands(there, spot) if self._puts(each, grasp, part, spot)), None)
                    if at is not None:
                        return {**at, part.name: spot}
        return None

    def _stands(self, poses: Poses, to: Frame) -> Iterator[Poses]:
        """Yield where all is if the base, if there is one, stands at the workstation where something is."""
        if not self.stations:
            yield poses
            return
        station = min(self.stations, key=lambda each: float(np.hypot(*(_find_table(each)[0] - to.position[:2]))))
        offsets = self.rng.uniform(-1.0, 1.0, (STANDS, 3)) * (STAND_M, STAND_M, STAND_RAD)
        for ahead, left, turned in (np.zeros(3), *offsets):
            turn = np.radians(station.yaw_deg) + turned
            base = Frame(np.array([*station.place(ahead, left), 0.0]), exp(np.array([0.0, 0.0, turn])))
            if not any(_is_in_table(base, each) for each in self.stations):
                yield {**poses, BASE: base}

    def _grasps(self, poses: Poses, arm: ArmInModel, part: Part) -> Iterator[Grasp]:
        """Yield the grasps from which the part can be lifted."""
        at = poses[part.name]
        for turn, pointing in product(QUARTERS, (DOWN, AHEAD)):
            axes = at.axes @ turn @ pointing
            width = float(np.abs(axes[:, 1] @ at.axes) @ part.size)
            for height in _heights(part, axes):
                hand = Frame(at.position + np.array([0.0, 0.0, height]), axes)
                q = self._reach(poses, arm, hand, width + ROOM_M, None)
                if q is None:
                    continue
                lifts = (hand, *_lift(hand))
                if self._follow(poses, arm, q, lifts, width, part.name):
                    yield Grasp(arm, hand, width, q)

    def _spots(self, part: Part, bin_: Bin) -> Iterator[Frame]:
        """Yield where the part may stand in a bin."""
        assert bin_.size is not None, "a bin has a body"
        height = TABLE_M + FLOOR_M + part.size[2] / 2 + 0.0005
        for turn, x, y in product(QUARTERS[:2], *(np.linspace(-0.35, 0.35, 5) for _ in range(2))):
            way = np.array([x * bin_.size[0], y * bin_.size[1]])
            half = np.abs(turn[:2, :2]) @ np.array(part.size[:2]) / 2
            if (np.abs(way) + half < np.array(bin_.size[:2]) / 2 - FLOOR_M).all():
                yield Frame(np.array([*(np.array(bin_.at[:2]) + way), height]), turn)

    def _puts(self, poses: Poses, grasp: Grasp, part: Part, spot: Frame) -> bool:
        """Whether the arm puts the part, as it holds it, to a spot, and withdraws."""
        before = poses[part.name]
        for turn in (np.eye(3), QUARTERS[2]):
            axes = spot.axes @ turn @ before.axes.T @ grasp.hand.axes
            offset = spot.axes @ turn @ before.axes.T @ (grasp.hand.position - before.position)
            hand = Frame(spot.position + offset, axes)
            after = {**poses, part.name: spot}
            held = {**poses, part.name: Frame(spot.position, spot.axes @ turn)}
            q = self._reach(after, grasp.arm, hand, grasp.opening_m + ROOM_M, None)
            above = Frame(hand.position + np.array([0.0, 0.0, 0.12]), axes)
            if q is not None and self._follow(held, grasp.arm, q, (hand, above), grasp.opening_m, part.name):
                return True
        return False

    def _reach(self, poses: Poses, arm: ArmInModel, hand: Frame, opening_m: float, held: str | None) -> Array | None:
        """Return a posture (nv,) in rad with the open hand at a pose, into which it comes in a line."""
        shoulder = self.data.xanchor[arm.joints[1].id]
        if np.linalg.norm(hand.position - shoulder) > FARTHEST_M:
            return None
        before = Frame(hand.position - APPROACH_M * hand.axes[:, 2], hand.axes)
        for _ in range(STARTS):
            q = arm.descend(self.rng.uniform(*arm.range.T), hand, 40)
            if q is not None and self._follow(poses, arm, q, (hand, before), opening_m, held):
                return q
        return None

    def _follow(
        self, poses: Poses, arm: ArmInModel, q: Array, corners: Sequence[Frame], opening_m: float, held: str | None
    ) -> bool:
        """Whether the hand goes along lines from a posture (nv,), with what it holds, and touches nothing."""
        begin = corners[0]
        relative: Frame | None = None
        if held is not None:
            relative = Frame(begin.axes.T @ (poses[held].position - begin.position), begin.axes.T @ poses[held].axes)
        for target in _sample(corners):
            found = arm.descend(q, target, 20)
            if found is None or np.abs(found - q).max() > 0.5:
                return False
            q, now = found, dict(poses)
            if held is not None and relative is not None:
                now[held] = Frame(target.position + target.axes @ relative.position, target.axes @ relative.axes)
            if not self._is_free(now, arm, q, opening_m, held):
                return False
        return True

    def _is_free(self, poses: Poses, arm: ArmInModel, q: Array, opening_m: float, held: str | None) -> bool:
        self._place(poses)
        self.data.qpos[arm.q_at] = q
        self.data.qpos[arm.fingers] = opening_m / 2
        mine = f"lab:{held}/"
        for pair in touching_bodies(self.model, self.data):
            of_held = held is not None and any(each.startswith(mine) for each in pair)
            if of_held and any(each.startswith(arm.hand) for each in pair):
                continue
            if of_held or _is_of_robot(pair):
                return False
        return True

    def _place(self, poses: Poses) -> None:
        """Put all parts, and the base, where they are, and all arms home."""
        for q_at, home in self.homes:
            self.data.qpos[q_at] = home
        for name, pose in poses.items():
            if name == BASE:
                self.data.mocap_pos[self.base] = pose.position
                mujoco.mju_mat2Quat(self.data.mocap_quat[self.base], np.ascontiguousarray(pose.axes).ravel())
                continue
            start = int(self.model.joint(f"lab:{name}/free").qposadr[0])
            self.data.qpos[start : start + 3] = pose.position
            mujoco.mju_mat2Quat(self.data.qpos[start + 3 : start + 7], np.ascontiguousarray(pose.axes).ravel())


def _lift(hand: Frame) -> tuple[Frame, ...]:
    """Return where the hand lifts what it has grasped: up, and back out if it is horizontal."""
    if hand.axes[2, 2] < -0.5:
        return (Frame(hand.position + np.array([0.0, 0.0, LIFT_M]), hand.axes),)
    up = hand.position + np.array([0.0, 0.0, SIDEWAYS_LIFT_M])
    return Frame(up, hand.axes), Frame(up - APPROACH_M * hand.axes[:, 2], hand.axes)


def _sample(corners: Sequence[Frame]) -> Iterator[Frame]:
    """Yield poses LINE_M apart on the lines through corners, turned as the first one."""
    yield corners[0]
    for one, other in pairwise(corners):
        count = max(1, round(float(np.linalg.norm(other.position - one.position)) / LINE_M))
        for index in range(1, count + 1):
            yield Frame(one.position + index / count * (other.position - one.position), corners[0].axes)


def _find_table(station: Station) -> tuple[Array, Array]:
    """Return the middle (2,) in m and the axes (2, 2) of the table of a station."""
    turn = np.radians(station.yaw_deg)
    axes = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    return np.array(station.place(station.away_m + TABLE_SIDES_M[0] / 2, 0.0)), axes


def _is_in_table(base: Frame, station: Station) -> bool:
    """Whether a base stands in a table: no axis of either rectangle separates them (S. Gottschalk 1996)."""
    (middle, axes), turned = _find_table(station), base.axes[:2, :2]
    between = middle - base.position[:2]
    for axis in (*axes.T, *turned.T):
        half = np.abs(axis @ turned) @ np.array(BASE_M[:2]) / 2 + np.abs(axis @ axes) @ np.array(TABLE_SIDES_M) / 2
        if abs(axis @ between) > half:
            return False
    return True


def _heights(part: Part, axes: Array) -> tuple[float, ...]:
    """Return how far above the middle of a part the hand takes it, in m."""
    if axes[2, 2] < -0.5:
        return (0.0, part.size[2] / 2 - 0.015, part.size[2] / 2 - 0.005)
    return (0.0, part.size[2] / 2 - 0.01)


def _is_of_robot(bodies: tuple[str, str]) -> bool:
    return any(each.startswith(("lab:Arm-", "lab:Hand-")) for each in bodies)
