"""Where a mobile base may stand at a workstation, and its way there: where that wants it to, then nearby."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import hypot

from skillc_runtime.collision.solid_geoms import find_overlap_m
from skillc_runtime.execution.refinement.failure import SpaceFailure
from skillc_runtime.execution.refinement.situation import BaseDrive, ChosenStand, ChosenWay, Situation
from skillc_runtime.primitives.space_needs import Stand
from skillc_runtime.world.space.base_ways import BaseWay, BlockedWay, describe_blocked, find_base_way
from skillc_runtime.world.space.floor_plan import FloorPlan
from skillc_runtime.world.space.frames import placement_changes, pose
from skillc_runtime.world.space.stands import read_stand, stand_changes, standing_pose
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import AT, HAS_ARM
from skillc_runtime.world.state.world_state import WorldState

FAR_M, TURNED_RAD = 0.45, 0.5
"""How far from where a workstation wants it a base is let stand, and turned."""

SAMPLES = 60
"""How many places are sampled."""

RAD_AS_M = 0.3
"""How far away a place counts for each rad that the base is turned there, in m."""

RATIOS = (0.8191725134, 0.6710436067, 0.5497004779)
"""Steps of an additive recurrence that leaves no gaps in three dimensions (M. Roberts 2018)."""


def list_stands(need: Stand, here: Situation) -> Iterator[Situation | SpaceFailure]:
    """Yield the situations with a base where a workstation wants it, then at places nearby where it has room.

    Where it would touch something there, or has no way, is a failure. FrameError if it is not known where the base is.
    """
    start = pose(here.state, need.robot)
    plan = FloorPlan(here.state, need.robot, start)
    for there in _list_rooms(need, here):
        way = find_base_way(plan, start, standing_pose(there.state, need.to))
        if isinstance(way, BaseWay):
            points = tuple((float(at.position[0]), float(at.position[1])) for at in (start, *way.poses))
            arms = frozenset(here.state.objects(need.robot, HAS_ARM))
            drive = BaseDrive(need.robot, points, plan.radius_m, plan.top_m, arms)
            yield replace(_with_way(need, there, way), drives=(*there.drives, drive))
            continue
        yield _explain(need, here.state, way)
        if not way.at_goal:
            return  # from anywhere near there is none either


def _with_way(need: Stand, there: Situation, way: BaseWay) -> Situation:
    if len(way.poses) == 1:
        return there
    words = there.state.vocabulary
    corners = tuple((round(float(at.position[0]), 3), round(float(at.position[1]), 3)) for at in way.poses[:-1])
    around = tuple(label(each, words) for each in way.around)
    chosen = ChosenWay(label(need.robot, words), label(need.to, words), corners, around)
    return replace(there, ways=(*there.ways, chosen))


def _explain(need: Stand, state: WorldState, way: BlockedWay) -> SpaceFailure:
    return SpaceFailure("in-the-way" if way.at_goal else "no-way", describe_blocked(way, state, need.robot, need.to))


def _list_rooms(need: Stand, here: Situation) -> Iterator[Situation]:
    """Yield the situations with a base where a workstation wants it, then at places nearby where it has room."""
    stated = read_stand(here.state, need.to)
    yield here if stated is None else _place(here, need)
    depth_m = find_overlap_m(_place(here, need).state, need.robot)
    for x_m, y_m, yaw_rad in _sample():
        chosen = here.with_changes([*stand_changes(need.to, x_m, y_m, yaw_rad)])
        there = _place(chosen, need)
        if find_overlap_m(there.state, need.robot) <= depth_m:
            robot, place = (label(each, here.state.vocabulary) for each in (need.robot, need.to))
            stand = ChosenStand(robot, place, x_m, y_m, yaw_rad)
            yield replace(there, stands=(*there.stands, stand))


def _place(here: Situation, need: Stand) -> Situation:
    """Return the situation with the base where the facts about the workstation say."""
    there = here.with_changes([AddRelation(need.robot, AT, need.to)])
    return there.with_changes([*placement_changes(need.robot, standing_pose(here.state, need.to))])


def _sample() -> list[tuple[float, float, float]]:
    """Return places in the frame of a workstation, in m and rad, the nearest first."""
    shares = [[2.0 * ((0.5 + number * each) % 1.0) - 1.0 for each in RATIOS] for number in range(1, SAMPLES + 1)]
    places = [(round(FAR_M * x, 3), round(FAR_M * y, 3), round(TURNED_RAD * turn, 3)) for x, y, turn in shares]
    return sorted(places, key=lambda each: hypot(each[0], each[1]) + RAD_AS_M * abs(each[2]))
