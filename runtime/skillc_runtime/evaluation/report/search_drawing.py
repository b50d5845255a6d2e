"""The data for the figure of one search: the search itself, the force of its push, and where the hole really is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skillc_runtime.evaluation.report.push_drawing import PushDrawing, make_push_drawing
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.searches import Search
from skillc_runtime.motion.pose import Array


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
