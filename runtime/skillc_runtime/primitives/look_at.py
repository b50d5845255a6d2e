"""Moves an arm until the camera on its flange sees all of a thing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.devices.motion_interface import MotionModel
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.primitives.arm_motion import ArmMotion
from skillc_runtime.primitives.collision_free_motion import move_collision_free
from skillc_runtime.primitives.computation import Computing
from skillc_runtime.primitives.primitive import SkillFailure, SpaceLacking
from skillc_runtime.primitives.space_needs import PutFlange, SpaceNeed
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.wrist_camera import find_wrist_camera, list_viewpoints, read_flange
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.world.state.values import Value
    from skillc_runtime.world.state.world_state import WorldState


class LookAt(ArmMotion):
    """Moves the arm at `pace`, a share of its greatest joint speeds, to where its camera sees all of a thing.

    From straight above if possible, and in the posture nearest to home. The motion avoids the obstacles in the world
    model, also with what the arm holds.
    """

    ends_free = True

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return that the flange gets to where the camera sees the thing."""
        arm, thing = arguments.get("arm"), arguments.get("thing")
        if not isinstance(arm, str) or not isinstance(thing, str):
            return None
        found = _list_flanges(state, arm, thing)
        return None if found is None else (PutFlange(arm, tuple(chain.from_iterable(found))),)

    @classmethod
    def find_problem(cls, arguments: Mapping[str, Value], state: WorldState) -> str | None:
        """Return that the arm has no camera."""
        arm = arguments.get("arm")
        if not isinstance(arm, str) or find_wrist_camera(state, arm) is not None:
            return None
        return _no_camera(state, arm)

    def __init__(self, cell: Cell, *, arm: str, thing: str, pace: float) -> None:
        super().__init__(cell, arm)
        self._thing, self._pace = thing, pace

    def start_motion(self) -> Computing:
        """Find a posture from which the camera sees the thing, and go; SkillFailure if there is none."""
        state, arm, now = self.cell.world.snapshot(), self._individual, self.arm.measured
        short = state.vocabulary.short
        try:
            flange = pose(state, arm) @ read_flange(state, arm).place_tool(now.q)
            groups, home = _list_flanges(state, arm, self._thing), sheet_of(state, arm).posture("home")
        except (FrameError, SheetError) as error:
            raise SkillFailure(str(error)) from error
        if groups is None:
            raise SkillFailure(_no_camera(state, arm))
        tool = flange.inverse() @ now.pose
        goals = _ViewGoal(tuple(tuple(each @ tool for each in group) for group in groups), home)
        unreachable = SpaceLacking(
            f"the arm takes no posture from which its camera sees all of {short(self._thing)} from above"
        )
        yield from move_collision_free(self.cell, arm, goals, self._pace, unreachable)


@dataclass(frozen=True, slots=True)
class _ViewGoal:
    """The postures that put the tool at one of several poses in the world; those of a group are as good.

    home (nv,): rad.
    """

    groups: tuple[tuple[Pose, ...], ...]
    home: Array

    def find(self, model: MotionModel) -> Iterator[Array]:
        """Yield them: those of the first group, the nearest to home first, then those of the next one."""
        for group in self.groups:
            found = [q for tool in group for q in model.rank_postures(tool, self.home)[:1]]
            yield from sorted(found, key=lambda q: float(np.abs(q - self.home).max()))


def _list_flanges(state: WorldState, arm: str, thing: str) -> tuple[tuple[Pose, ...], ...] | None:
    """Return poses of an arm's flange in the world at which its camera sees a thing, in groups as good, the best first.

    None if the arm has no camera.
    """
    camera = find_wrist_camera(state, arm)
    if camera is None:
        return None
    back = camera.on_flange.inverse()
    return tuple(tuple(each @ back for each in group) for group in list_viewpoints(state, thing, camera.lens))


def _no_camera(state: WorldState, arm: str) -> str:
    return (
        f"{state.vocabulary.short(arm)} has no camera on its flange: state `skillc:hasSensor` with a "
        "skillc:InspectionCamera that has a skillc:ImageSheet"
    )
