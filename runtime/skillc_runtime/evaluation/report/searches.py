"""Finds in the pushes of a run what was searched for with the pressed tool, and measures it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import msgspec
import numpy as np

from skillc_runtime.evaluation.report.pushes import PushDrawing, PushRecord, find_pushes, make_push_drawing
from skillc_runtime.evaluation.report.result import SearchResult
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.run_trace import ArmPath
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.labels.labelling import label

WORLD = ("x in the world", "y in the world")
LEVEL_COSINE = 0.99
"""A push is vertical if the cosine of its angle to the vertical is greater."""


class Search(msgspec.Struct, frozen=True):
    """A search within a push, from `start_s` to `end_s`; `found` if something gave way.

    across (2, 3): two perpendicular unit vectors in the world, across the push; `names` of these directions.
    """

    push: PushRecord
    start_s: float
    end_s: float
    found: bool
    across: Array
    names: tuple[str, str]

    @property
    def samples(self) -> ArmPath:
        """The samples during the search."""
        return self.push.samples.between(self.start_s, self.end_s)

    def in_plane(self, points: Array) -> Array:
        """Return points (n, 3) in m in the plane across the push (n, 2), in mm from where the search began."""
        return np.asarray(1e3 * (points - self.samples.position[0]) @ self.across.T)


def find_searches(record: RunRecord) -> tuple[Search, ...]:
    """Return all searches of a run in order of time."""
    return tuple(each for push in find_pushes(record) for each in _find_in(push, record))


def measure_search(search: Search, record: RunRecord) -> SearchResult:
    """Return the numbers of a search."""
    vocabulary, path = record.state.vocabulary, search.in_plane(search.samples.position)
    away = np.linalg.norm(path, axis=1)
    travel = search.push.travel_mm[search.push.samples.time >= search.start_s]
    return SearchResult(
        skill=search.push.within.skill,
        arm=label(search.push.arm, vocabulary),
        on=tuple(label(each, vocabulary) for each in search.push.on),
        start_s=search.start_s,
        end_s=search.end_s,
        path_mm=float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum()),
        radius_mm=float(away.max()),
        found_mm=float(away[-1]) if search.found else None,
        depth_mm=float(travel.max() - travel[0]),
    )


def _find_in(push: PushRecord, record: RunRecord) -> Iterator[Search]:
    names, across = _find_plane(push.along)
    for call in (call for part in push.body for call in part.all if push.arm in call.individuals):
        if call.activity != "search" or call.started is None:
            continue
        end = record.end_s if call.ended is None else call.ended
        if push.start_s <= call.started and end <= push.end_s and len(push.samples.between(call.started, end).time) > 1:
            yield Search(push, call.started, end, call.status == "success", across, names)


def _find_plane(along: Array) -> tuple[tuple[str, str], Array]:
    """Return the names of two directions across a push and the directions (2, 3): x and y if it is vertical."""
    if abs(along[2]) > LEVEL_COSINE:
        return WORLD, np.eye(3)[:2]
    level = np.cross((0.0, 0.0, 1.0), along)
    level = level / np.linalg.norm(level)
    return ("across, level", "across, upwards"), np.stack([level, np.cross(along, level)])


@dataclass(frozen=True, slots=True)
class SearchDrawing:
    """A search to draw: the force of its push, and the true place (2,) of the hole in its plane, None if not known."""

    search: Search
    force: PushDrawing
    hole_mm: Array | None


def make_search_drawing(search: Search, record: RunRecord) -> SearchDrawing:
    """Return what is drawn of a search."""
    return SearchDrawing(search, make_push_drawing(search.push, record), _find_hole(search, record))


def _find_hole(search: Search, record: RunRecord) -> Array | None:
    """Return where the fixture that the search is about really is, (2,) mm in the plane."""
    truth = record.truth
    if truth is None:
        return None
    for each in search.push.on:
        try:
            place = truth.fixture_pose(each).position
        except KeyError:
            continue
        return np.asarray(search.in_plane(place[None])[0])
    return None
