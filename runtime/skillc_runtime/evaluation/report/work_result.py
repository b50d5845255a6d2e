"""The numbers of each kind of work of a run, as they are in result.json: a type for each kind."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_runtime.world.state.labels.labelled import LabelledIri

ForceSource: TypeAlias = Literal["sensor", "estimate"]
"""What an arm knows a force from: a force-torque sensor, or an estimate from its motors."""


class PushResult(msgspec.Struct, frozen=True, kw_only=True, tag="push"):
    """A tool was pressed on something: times in s, forces in N opposite to the push, travel in mm after contact.

    `skill` is the innermost skill around the push, `on` what its parameters name besides devices. The mean and the
    greatest force are those that the arm knew, from `force_source`, while there was contact; `true_` ones are those of
    the simulator, None where it has none. `contact_s` is when something was touched, by the simulator if it has the
    force, None if nothing was.
    """

    skill: str
    arm: LabelledIri
    on: tuple[LabelledIri, ...]
    start_s: float
    end_s: float
    contact_s: float | None
    force_command_n: float
    force_mean_n: float | None
    force_greatest_n: float | None
    force_source: ForceSource
    true_mean_n: float | None
    true_greatest_n: float | None
    travel_mm: float | None


class SearchResult(msgspec.Struct, frozen=True, kw_only=True, tag="search"):
    """Something was searched for with a pressed tool, as the arm measured it: times in s, lengths in mm.

    `path_mm` is how far the tool went across the push, `radius_mm` how far from where the search began it came,
    `found_mm` how far from there it was when something gave way, None if nothing did. `depth_mm` is how far it then
    sank below where it had searched, to the end of the push.
    """

    skill: str
    arm: LabelledIri
    on: tuple[LabelledIri, ...]
    start_s: float
    end_s: float
    path_mm: float
    radius_mm: float
    found_mm: float | None
    depth_mm: float


class GuidanceResult(msgspec.Struct, frozen=True, kw_only=True, tag="guidance"):
    """An arm yielded in all directions, so that it could be guided: times in s, lengths in mm, speed in mm/s.

    The forces in N of whoever guided it are those of the simulator; None if nobody did.
    """

    arm: LabelledIri
    start_s: float
    end_s: float
    path_mm: float
    moved_mm: float
    greatest_speed_mm_s: float
    person_mean_n: float | None
    person_greatest_n: float | None


class GraspResult(msgspec.Struct, frozen=True, kw_only=True, tag="grasp"):
    """A thing was grasped by a gripper: times in s, None if it was held to the end, and the grip 0.2 s after the grasp.

    force_n: with which each finger presses, by the simulator, None where it computes none; opening_mm: by the sensor of
    the fingers.
    """

    thing: LabelledIri
    gripper: LabelledIri
    grasped_s: float
    released_s: float | None
    force_n: float | None
    opening_mm: float | None


class DriveResult(msgspec.Struct, frozen=True, kw_only=True, tag="drive"):
    """A mobile base drove during the run: the length of its path in m, by the simulator."""

    robot: LabelledIri
    path_m: float


WorkResult: TypeAlias = PushResult | SearchResult | GuidanceResult | GraspResult | DriveResult
