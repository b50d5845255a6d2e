"""Drives a mobile base to a workstation: to its pose, or where beside it bases are stated to stand."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from skillc_runtime.devices.cell import Cell
from skillc_runtime.primitives.fact_monitor import base_away_from
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.primitives.space_needs import SpaceNeed, Stand
from skillc_runtime.primitives.standing_bases import leaving_changes
from skillc_runtime.primitives.time_limits import drive_limit_s
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.space.stands import read_stand, standing_pose
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.labelled import Quantity
from skillc_runtime.world.state.labelling import label
from skillc_runtime.world.state.terms import AT, HAS_ARM
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


class DriveBase(Primitive):
    """Drives to a workstation and writes the place that the base reports; the arms on it hold their posture."""

    moves = MappingProxyType({"robot": "to"})
    stays_put = True

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return that the base stands there."""
        robot, to = arguments.get("robot"), arguments.get("to")
        return (Stand(robot, to),) if isinstance(robot, str) and isinstance(to, str) else None

    def __init__(self, cell: Cell, *, robot: str, to: str) -> None:
        super().__init__(cell)
        self._base, self._robot, self._to = cell.base(robot), robot, to
        self._arms = sorted(cell.world.snapshot().objects(robot, HAS_ARM))
        self._limit_s = self._ends = 0.0

    def start(self) -> None:
        """Start driving."""
        state = self.cell.world.snapshot()
        goal = standing_pose(state, self._to)
        far = float(np.linalg.norm(goal.position[:2] - self._base.pose.position[:2]))
        self._limit_s = drive_limit_s(state, self._robot, far, self._base.speed)
        self._ends = self.cell.now + self._limit_s
        if leaving := leaving_changes(state, self._robot):
            self.cell.world.commit(leaving, "DriveBase", "reported")
        self._base.drive_to(goal)

    def tick(self) -> Status:
        """Return SUCCESS when the base has arrived; SkillFailure if it reports another place, or does not arrive."""
        self._check_stopped()
        if not self._base.done:
            if self.cell.now > self._ends:
                raise self._absence()
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
            limit=Quantity(self._limit_s, "s"),
            away=Quantity(float(np.linalg.norm(away)), "m"),
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
