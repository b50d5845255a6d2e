"""Where the things that a run moved ended up, how that is known, and how far from there they really are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from math import degrees, hypot
from types import MappingProxyType

import msgspec
import numpy as np

from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.evaluation.report.result import PlacementResult
from skillc_runtime.motion.pose import Pose, log
from skillc_runtime.world.space.frame_tree import FrameError, frame_tree_of
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.evidence import DecidingWrite, describe_evidence
from skillc_runtime.world.state.facts import PropertyFact, RelationFact
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAIN, END_EFFECTOR, MANIPULATABLE, POSITION
from skillc_runtime.world.state.world_state import WorldState


class _Move(msgspec.Struct, frozen=True):
    """A write that moved a thing: about the pose of the thing, or of what carries it."""

    thing: str
    moved: str
    write: DecidingWrite


NO_TARGETS: Mapping[str, tuple[float, float]] = MappingProxyType({})


def measure_placements(
    world: WorldModel, truth: GroundTruth | None, targets: Mapping[str, tuple[float, float]] = NO_TARGETS
) -> tuple[PlacementResult, ...]:
    """Return where each thing that was moved is believed to be and really is, in order of IRI.

    Where things really are is left out where the `truth` is not known.

    `targets` are the places (x, y) in m in the world where things should be, by IRI.
    """
    state = world.snapshot()
    moves = ((thing, _find_last_move(world, state, thing)) for thing in _movable(state))
    return tuple(_measure(world, state, truth, move, targets.get(thing)) for thing, move in moves if move is not None)


def _movable(state: WorldState) -> list[str]:
    return sorted(state.instances(MANIPULATABLE)) if CONTAIN in state.vocabulary.relations else []


def _measure(
    world: WorldModel,
    state: WorldState,
    truth: GroundTruth | None,
    move: _Move,
    target: tuple[float, float] | None,
) -> PlacementResult:
    thing, along = move.thing, move.thing != move.moved
    holder = min(state.subjects(CONTAIN, thing), default=None)
    vocabulary, believed, true = state.vocabulary, _believed(state, thing), _true(truth, thing)
    contained = None if holder is None else world.deciding_write(RelationFact(holder, CONTAIN, thing))
    off = None if believed is None or true is None else believed.inverse() @ true
    is_held = holder is not None and state.is_a(holder, END_EFFECTOR)
    intended = None if is_held or along else target
    return PlacementResult(
        thing=label(thing, vocabulary),
        holder=None if holder is None else label(holder, vocabulary),
        is_held=is_held,
        holder_known=describe_evidence(contained) if holder is not None else "",
        believed_m=None if believed is None else _numbers(believed),
        true_m=None if true is None else _numbers(true),
        known=describe_evidence(move.write),
        error_m=None if off is None else float(np.linalg.norm(off.position)),
        turned_deg=None if off is None else degrees(float(np.linalg.norm(log(off.rotation)))),
        intended_m=intended,
        missed_m=None if intended is None or true is None else _distance_in_plane(intended, true),
        moved_with=label(move.moved, vocabulary) if along else None,
    )


def _find_last_move(world: WorldModel, state: WorldState, thing: str) -> _Move | None:
    """Return the last write about the pose of a thing or of what carries it, to any depth; None if there is none."""
    moves = [
        _Move(thing, each, write)
        for each in _with_carriers(state, thing)
        if (write := world.deciding_write(PropertyFact(each, POSITION[0]))) is not None
    ]
    return max(moves, key=lambda each: each.write.number, default=None)


def _with_carriers(state: WorldState, thing: str) -> Iterator[str]:
    """Yield a thing and the things to handle that carry it, from the inside out."""
    yield thing
    with suppress(FrameError):
        pose(state, thing)
        at = frame_tree_of(state).carrier(thing)
        while at is not None and state.is_a(at, MANIPULATABLE):
            yield at
            at = frame_tree_of(state).carrier(at)


def _believed(state: WorldState, thing: str) -> Pose | None:
    try:
        return pose(state, thing)
    except FrameError:
        return None


def _true(truth: GroundTruth | None, thing: str) -> Pose | None:
    try:
        return None if truth is None else truth.body_pose(thing)
    except KeyError:
        return None


def _distance_in_plane(intended: tuple[float, float], true: Pose) -> float:
    return hypot(intended[0] - float(true.position[0]), intended[1] - float(true.position[1]))


def _numbers(at: Pose) -> tuple[float, float, float]:
    x, y, z = at.position.tolist()
    return x, y, z
