"""Drives a mobile base to a workstation: to its pose, or where beside it bases are stated to stand.

Straight, or around what is known to stand in the straight way.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from types import MappingProxyType

import numpy as np

from skillc_runtime.devices.cell import Cell
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.computation import Computation, Computing
from skillc_runtime.primitives.fact_monitor import base_away_from
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, SpaceLacking, Status
from skillc_runtime.primitives.space_needs import SpaceNeed, Stand
from skillc_runtime.primitives.standing_bases import leaving_changes
from skillc_runtime.primitives.time_limits import drive_limit_s
from skillc_runtime.world.space.base_ways import BaseWay, BlockedWay, describe_blocked, find_base_way, find_straight_way
from skillc_runtime.world.space.floor_plan import FloorPlan
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.space.stands import read_stand, standing_pose
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.labels.labelled import LabelledQuantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import AT, HAS_ARM
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


class DriveBase(Primitive):
    """Drives to a workstation and writes the place that the base reports; the arms on it hold their posture."""

    moves = MappingProxyType({"robot": "to"})
    stays_put = True

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return that the base stands there, to where it has a way."""
        robot, to = arguments.get("robot"), arguments.get("to")
        return (Stand(robot, to),) if isinstance(robot, str) and isinstance(to, str) else None

    def __init__(self, cell: Cell, *, robot: str, to: str) -> None:
        super().__init__(cell)
        self._base, self._robot, self._to = cell.base(robot), robot, to
        self._arms = sorted(cell.world.snapshot().objects(robot, HAS_ARM))
        self._limit_s = self._ends = 0.0
        self._left: tuple[Pose, ...] = ()

    def start(self) -> None:
        """Start driving straight, or look for a way around what is in the straight way."""
        state, at = self.cell.world.snapshot(), self._base.pose
        goal = standing_pose(state, self._to)
        try:
            plan = FloorPlan(state, self._robot, at)
        except FrameError:  # nobody knows what is around it: it drives as it can
            straight: BaseWay | None = BaseWay((goal,))
        else:
            straight = find_straight_way(plan, at, goal)
        if straight is None:
            self.computing = self._drive_around(plan, at, goal)
        else:
            self._drive(straight.poses)

    def _drive_around(self, plan: FloorPlan, at: Pose, goal: Pose) -> Computing:
        """Drive on a way around what is in the straight one; SpaceLacking without one, before anything moves."""
        way = yield Computation(find_base_way, (plan, at, goal), name="the search for a way")
        if isinstance(way, BlockedWay):
            raise SpaceLacking(describe_blocked(way, self.cell.world.snapshot(), self._robot, self._to))
        self._drive(way.poses)

    def _drive(self, poses: Sequence[Pose]) -> None:
        """Drive straight to poses, one after another."""
        state = self.cell.world.snapshot()
        self._limit_s = sum(
            drive_limit_s(
                state, self._robot, float(np.linalg.norm((there.position - at.position)[:2])), self._base.speed
            )
            for at, there in pairwise((self._base.pose, *poses))
        )
        self._ends = self.cell.now + self._limit_s
        if leaving := leaving_changes(state, self._robot):
            self.cell.world.commit(leaving, "DriveBase", "reported")
        self._left = tuple(poses[1:])
        self._base.drive_to(poses[0])

    def tick(self) -> Status:
        """Return SUCCESS when the base has arrived; SkillFailure if it reports another place, or does not arrive."""
        self._check_stopped()
        if not self._base.done:
            if self.cell.now > self._ends:
                raise self._absence()
            return Status.RUNNING
        if self._left:
            self._base.drive_to(self._left[0])
            self._left = self._left[1:]
            return Status.RUNNING
        state = self.cell.world.snapshot()
        goal = standing_pose(state, self._to)
        elsewhere = base_away_from(self.cell, self._robot, self._to, goal, state)()
        if elsewhere is not None:
            raise SkillFailure(elsewhere)
        beside = [] if read_stand(state, self._to) is None else placement_changes(self._robot, goal)
        self.cell.world.commit([AddRelation(self._robot, AT, self._to), *beside], "DriveBase", "reported")
        return Status.SUCCESS

    def _check_stopped(self) -> None:
        """Raise SkillFailure if the base, or one of its arms, stopped by itself on the way."""
        vocabulary = self.cell.world.snapshot().vocabulary
        faults = {self._robot: self._base.fault} | {arm: self.cell.arm(arm).take_fault() for arm in self._arms}
        for device, fault in faults.items():
            if fault is not None:
                to, place = vocabulary.short(self._to), self._base.pose.position
                raise SkillFailure(
                    f"{vocabulary.short(device)} stopped on the way to {to}: {fault}; the base is at "
                    f"({place[0]:.2f}, {place[1]:.2f}) m in the frame 'map'"
                )

    def _absence(self) -> SkillFailure:
        state = self.cell.world.snapshot()
        away = standing_pose(state, self._to).position[:2] - self._base.pose.position[:2]
        return SkillFailure(
            "{robot} has not arrived at {to} within {limit:.0f}: it is {away:.2f} away from there",
            robot=label(self._robot, state.vocabulary),
            to=label(self._to, state.vocabulary),
            limit=LabelledQuantity(self._limit_s, "s"),
            away=LabelledQuantity(float(np.linalg.norm(away)), "m"),
        )

    def halt(self, reason: str) -> None:
        """Brake."""
        self._base.stop()

    def pause(self) -> None:
        """Brake."""
        self._base.stop()

    def resume(self) -> None:
        """Drive on from the current pose."""
        self.start()
