"""The data for the figures of pick and place: the path of a hand, where things lay and lie, the grip of each pick."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import inf
from typing import Literal, TypeAlias

import numpy as np

from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.evaluation.report.handlings import Handling
from skillc_runtime.evaluation.report.run_trace import HandPath, HandTrace
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bodies import read_bodies, read_body
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.shape.outlines import outline_points
from skillc_runtime.world.state.labels.labelled import display_name
from skillc_runtime.world.state.terms import CONTAINER, TOOL
from skillc_runtime.world.state.world_state import WorldState

Role: TypeAlias = Literal["scenery", "place", "start", "believed start", "end", "believed end"]
"""What an outline shows: furniture, a container, or a thing that was moved, where it really was or was believed."""

DIFFERENT_M = 0.005
"""A believed pose is drawn if it is farther than this from the true one."""

BEFORE_S, AFTER_S = 2.0, 2.0
"""How much is shown before a grasp and after a release."""

AROUND_M = 0.15
"""Furniture is drawn if the hand came that near to it."""


MARGIN_MM = 50.0
"""How much is shown around what was handled."""


@dataclass(frozen=True, slots=True)
class DrawnBody:
    """A body to draw: its display name, its role, points (n, 3) in m of the world whose hull it is, its colour."""

    name: str
    role: Role
    points: Array
    colour: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Pick:
    """One pick: the name of the thing, samples of the hand, times in s of the grasp and the release, or None."""

    name: str
    samples: HandPath
    grasped_s: float
    released_s: float | None


@dataclass(frozen=True, slots=True)
class HandlingDrawing:
    """What one hand did: its display name, its true path, what lay around it, and its picks in order of time."""

    hand: str
    path: HandPath
    outlines: tuple[DrawnBody, ...]
    picks: tuple[Pick, ...]


def make_handling_drawings(
    handlings: Sequence[Handling], trace: HandTrace, state: WorldState, truth: GroundTruth
) -> tuple[HandlingDrawing, ...]:
    """Return a drawing for each gripper that held a thing, in order of IRI; `state` is that at the end.

    Tools are left out: what matters about them is their work.
    """
    drawn = [each for each in handlings if not state.is_a(each.thing, TOOL)]
    grippers = sorted({each.gripper for each in drawn})
    return tuple(
        _draw([each for each in drawn if each.gripper == gripper], gripper, trace, state, truth) for gripper in grippers
    )


def choose_axes(drawings: Sequence[HandlingDrawing]) -> int:
    """Return which axis of the world lies across in the figures of all hands: 0 for x, 1 for y, the longer one."""
    if not drawings:
        return 0
    shown = np.vstack([find_extent(each) for each in drawings])
    return 0 if np.ptp(shown[:, 0]) > np.ptp(shown[:, 1]) else 1


def find_extent(drawing: HandlingDrawing) -> Array:
    """Return the least and the greatest coordinates (2, 3) in mm that are shown."""
    handled = [each.points for each in drawing.outlines if each.role != "scenery"]
    picked = [pick.samples.position for pick in drawing.picks]
    every = 1e3 * np.vstack([*picked, *handled])
    return np.stack([every.min(axis=0) - MARGIN_MM, every.max(axis=0) + MARGIN_MM])


def _draw(
    handlings: Sequence[Handling], gripper: str, trace: HandTrace, state: WorldState, truth: GroundTruth
) -> HandlingDrawing:
    path = trace.path(gripper)
    things = sorted({each.thing for each in handlings})
    around = (*_scenery(trace.start, path), *_moved(things, trace, state, truth))
    return HandlingDrawing(display_name(gripper), path, around, tuple(_pick(each, path) for each in handlings))


def _pick(handling: Handling, path: HandPath) -> Pick:
    end = inf if handling.released_s is None else handling.released_s + AFTER_S
    samples = path.between(handling.grasped_s - BEFORE_S, end)
    return Pick(display_name(handling.thing), samples, handling.grasped_s, handling.released_s)


def _scenery(state: WorldState, path: HandPath) -> Iterator[DrawnBody]:
    """Yield the fixed things near the path."""
    for body in read_bodies(state):
        points = outline_points(state, body.individual, body.pose)
        if not body.movable and _is_near(points, path.position):
            role: Role = "place" if state.is_a(body.individual, CONTAINER) else "scenery"
            yield DrawnBody(display_name(body.individual), role, points, body.colour[:3])


def _is_near(points: Array, path: Array) -> bool:
    low, high = points.min(axis=0) - AROUND_M, points.max(axis=0) + AROUND_M
    return bool(np.any(np.all((path >= low) & (path <= high), axis=1)))


def _moved(things: Sequence[str], trace: HandTrace, state: WorldState, truth: GroundTruth) -> Iterator[DrawnBody]:
    """Yield where things lay at the start and lie at the end; where they were believed to be, if that differs."""
    for thing in things:
        body = read_body(trace.start, thing)
        colour = (0.5, 0.5, 0.5) if body is None else body.colour[:3]
        end = truth.body_pose(thing)
        start = trace.lay.get(thing, end)
        shown: list[tuple[Role, Pose]] = [("start", start), ("end", end)]
        shown += [("believed start", at) for at in _believed_elsewhere(trace.start, thing, start)]
        shown += [("believed end", at) for at in _believed_elsewhere(state, thing, end)]
        for role, at in shown:
            yield DrawnBody(display_name(thing), role, outline_points(state, thing, at), colour)


def _believed_elsewhere(state: WorldState, thing: str, really: Pose) -> Iterator[Pose]:
    """Yield the believed pose of a thing, if there is one and it is elsewhere."""
    with suppress(FrameError):
        believed = pose(state, thing)
        if np.linalg.norm(believed.position - really.position) > DIFFERENT_M:
            yield believed
