"""The plan of a tool's reference as numbers, from which it is sampled in every control period without Python objects.

`ReferenceGenerator` writes the plan whenever the motion changes.
"""

from __future__ import annotations

from math import inf

import msgspec
import numpy as np

from skillc_runtime.motion.arrays import Matrix, OutMatrix, OutVector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import copy_matrix, cross, product, rotation_by, times
from skillc_runtime.motion.overlays import CIRCLE, SINES, SPIRAL, circle_at, faded_at, sines_at, spiral_at
from skillc_runtime.motion.paths.path import COLUMNS_OF_PATH, path_at
from skillc_runtime.motion.paths.profile import trapezoid_at
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.stopping_motion import stop_at
from skillc_runtime.motion.time_scaling import scaled_time

MOTION, OVERLAID = 0, 1
"""Rows of `ReferencePlan.clocks`: motion time and overlay time."""

WAY, TURN = 0, 1
"""Rows of `ReferencePlan.stops`: how the motion before comes to rest."""

AT_REST, ALONG_TABLE, GIVEN = 0.0, 1.0, 2.0
"""Kinds of motions: none; a path by its table; any other, of which `path` has the sample already."""

KIND, ENDS, FACTOR, SHIFTED = range(4)
"""Entries of `ReferencePlan.motion`. ENDS: s; FACTOR: by how much the path is slowed down; SHIFTED: 1 with a shift."""

OVERLAY_KIND, START, FADE, END = range(4)
OVERLAY_AXES, PARAMETERS, OVERLAY_COLUMNS = 4, 13, 22
"""Columns of `ReferencePlan.overlays`: kind, times in s, axes (3, 3), and what the kind is described by, (9,)."""

MOST_OVERLAYS = 8

SHIFT_START, SHIFT_WAY, SHIFT_PROFILE, SHIFT_SINCE, SHIFT_NUMBERS = 0, 3, 6, 11, 12
"""Entries of `ReferencePlan.shift`: vectors in m, the numbers of the profile, and s."""

NO_TABLE: Array = np.zeros((0, COLUMNS_OF_PATH))


class ReferencePlan(msgspec.Struct, frozen=True):
    """All that the reference of a tool depends on, in one frame, and the last sample.

    rows, path (8, 3): the sample and the same without overlays and shift, as in `Reference`; rest (8, 3): where the
    motion ends. clocks (2, 5): see `TimeScaling`; stops (2, 4): velocity in m/s or rad/s and duration in s; motion
    (4,); overlays (8, 22); shift (12,). table (n, 35): of a `Path`.
    """

    rows: OutMatrix
    path: OutMatrix
    rest: OutMatrix
    clocks: OutMatrix
    stops: OutMatrix
    motion: OutVector
    overlays: OutMatrix
    shift: OutVector
    table: Matrix


def make_plan() -> ReferencePlan:
    """Return a plan without any motion."""
    rows, path, rest = np.zeros((3, 8, 3))
    overlays = np.zeros((MOST_OVERLAYS, OVERLAY_COLUMNS))
    overlays[:, END] = inf
    return ReferencePlan(
        rows, path, rest, np.zeros((2, 5)), np.zeros((2, 4)), np.zeros(4), overlays, np.zeros(SHIFT_NUMBERS), NO_TABLE
    )


@inlined
def _clock_at(clock: Array, now: float) -> tuple[float, float, float]:
    return scaled_time(clock[0], clock[1], clock[2], clock[3], clock[4], now)


@inlined
def _brake(rows: Array, stops: Array, time: float) -> None:
    """Add the rest of the motion before to the rows of a reference: r = offset + r_b, R = E R_b."""
    way, turn, E = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
    turned, turning, change, spun = np.empty((3, 3)), np.empty(3), np.empty(3), np.empty(3)
    stop_at(way, stops[WAY, :3], stops[WAY, 3], time)
    stop_at(turn, stops[TURN, :3], stops[TURN, 3], time)
    rotation_by(turn[0], E)
    product(E, rows[1:4], turned)
    times(E, rows[5], turning)
    times(E, rows[7], change)
    cross(turn[1], turning, spun)
    for i in range(3):
        rows[0, i] += way[0, i]
        rows[4, i] += way[1, i]
        rows[6, i] += way[2, i]
        rows[5, i] = turning[i] + turn[1, i]
        rows[7, i] = turn[2, i] + change[i] + spun[i]
        for j in range(3):
            rows[1 + i, j] = turned[i, j]


@inlined
def sample_path(plan: ReferencePlan, now: float) -> None:
    """Compute `path` at `now` s: the motion, the rest of the one before it, both as fast as their time runs."""
    path, kind, factor = plan.path, plan.motion[KIND], plan.motion[FACTOR]
    time, rate, slope = _clock_at(plan.clocks[MOTION], now)
    if time >= plan.motion[ENDS]:
        copy_matrix(plan.rest, path)
        return
    if kind == ALONG_TABLE:
        path_at(path, plan.table, time / factor)
        for i in range(3):
            path[4, i], path[5, i] = path[4, i] / factor, path[5, i] / factor
            path[6, i], path[7, i] = path[6, i] / (factor * factor), path[7, i] / (factor * factor)
    elif kind == AT_REST:
        copy_matrix(plan.rest, path)
    if time < plan.stops[WAY, 3] or time < plan.stops[TURN, 3]:
        _brake(path, plan.stops, time)
    if rate != 1.0:
        for row in range(4, 6):
            for i in range(3):
                velocity = path[row, i]
                path[row, i] = rate * velocity
                path[row + 2, i] = rate * rate * path[row + 2, i] + slope * velocity


@inlined
def _add_overlays(plan: ReferencePlan, now: float) -> bool:
    """Add all overlays to `rows`; return whether one has faded out."""
    rows, over = plan.rows, False
    motion, added = np.zeros((3, 3)), np.empty((3, 3))
    time, rate, slope = _clock_at(plan.clocks[OVERLAID], now)
    for each in range(plan.overlays.shape[0]):
        overlay = plan.overlays[each]
        kind, start, parameters = overlay[OVERLAY_KIND], overlay[START], overlay[PARAMETERS:]
        if kind == 0.0:
            continue
        for i in range(3):
            motion[i, 2] = 0.0
        if kind == CIRCLE:
            circle_at(motion, parameters[0], parameters[1], time - start)
        elif kind == SPIRAL:
            spiral_at(motion, parameters[0], parameters[1], parameters[2], time - start)
        elif kind == SINES:
            sines_at(motion, parameters[:3], parameters[3:6], parameters[6:], time - start)
        else:
            for i in range(9):
                motion[i // 3, i % 3] = parameters[i]
        faded_at(motion, start, overlay[FADE], overlay[END], time)
        product(motion, overlay[OVERLAY_AXES:PARAMETERS].reshape(3, 3).T, added)
        for i in range(3):
            rows[0, i] += added[0, i]
            rows[4, i] += rate * added[1, i]
            rows[6, i] += slope * added[1, i] + rate * rate * added[2, i]
        over = over or time >= overlay[END] + overlay[FADE]
    return over


@inlined
def _add_shift(plan: ReferencePlan, now: float) -> None:
    """Add the displacement of a `Shift` to `rows`."""
    rows, shift = plan.rows, plan.shift
    p = shift[SHIFT_PROFILE:SHIFT_SINCE]
    share, rate, change = trapezoid_at(p[0], p[1], p[2], p[3], p[4], now - shift[SHIFT_SINCE])
    for i in range(3):
        way = shift[SHIFT_WAY + i]
        rows[0, i] += shift[SHIFT_START + i] + share * way
        rows[4, i] += rate * way
        rows[6, i] += change * way


@inlined
def sample_plan(plan: ReferencePlan, now: float) -> bool:
    """Compute `path` and `rows` at `now` in s; return whether an overlay has faded out."""
    sample_path(plan, now)
    copy_matrix(plan.path, plan.rows)
    over = _add_overlays(plan, now)
    if plan.motion[SHIFTED] != 0.0:
        _add_shift(plan, now)
    return over


@compiled
def sample_reference(plan: ReferencePlan, now: float) -> bool:
    """Compute `path` and `rows` at `now` in s; return whether an overlay has faded out."""
    return sample_plan(plan, now)
