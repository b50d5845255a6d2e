"""Finds in a run what was picked up and put down, and where that ended up: as believed, and as it really is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from math import degrees, hypot
from types import MappingProxyType

import msgspec
import numpy as np
from msgspec.structs import replace

from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.evaluation.report.result import PlacementResult
from skillc_runtime.motion.pose import Pose, log
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.recording.history.history import RecordedCall, RunHistory
from skillc_runtime.world.space.frame_tree import FrameError, frame_tree_of
from skillc_runtime.world.space.frames import find_pose, pose, size
from skillc_runtime.world.state.evidence import DecidingWrite, describe_evidence
from skillc_runtime.world.state.facts import PropertyFact, RelationFact
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledPose
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import ARM_DEVICE, CONTAIN, END_EFFECTOR, MANIPULATABLE, POSITION
from skillc_runtime.world.state.world_state import WorldState

GRASPED, RELEASED = "grasped", "released"
"""The words with which primitives highlight that they have grasped or released something."""

TARGET = "target"
"""The name of the parameter with the pose to which a skill moves the tool."""

NO_TARGETS: Mapping[str, tuple[float, float]] = MappingProxyType({})


class Handling(msgspec.Struct, frozen=True):
    """A thing that a gripper of an arm held, all by IRI, from `grasped_s` to `released_s`; None if it never let go.

    `target_m` is the place (x, y) in m in the world to which the arm was last sent before it let go: where the middle
    of the thing should be. None if it is not known.
    """

    thing: str
    arm: str
    gripper: str
    grasped_s: float
    released_s: float | None = None
    target_m: tuple[float, float] | None = None


def find_handlings(history: RunHistory, state: WorldState) -> tuple[Handling, ...]:
    """Return what was picked up in a run, in order of time, from the highlights of its primitives."""
    ended = ((call.ended, call) for call in history.calls if call.status == "success" and call.ended is not None)
    calls = sorted(ended, key=_by_time)
    found: list[Handling] = []
    highlights = ((time, choice, each) for time, choice in calls for each in choice.highlights)
    for ended_s, call, highlight in highlights:
        if highlight.word == GRASPED:
            found += _begin(highlight.what.iri, call, ended_s, state)
        elif highlight.word == RELEASED:
            _end(found, highlight.what.iri, ended_s, calls, state)
    return tuple(found)


def find_targets(handlings: Sequence[Handling]) -> dict[str, tuple[float, float]]:
    """Return where the middle of each thing should be, (x, y) in m in the world, by IRI: that of its last handling."""
    last = {each.thing: each for each in handlings}
    return {thing: each.target_m for thing, each in last.items() if each.target_m is not None}


def _by_time(call: tuple[float, RecordedCall]) -> float:
    return call[0]


def _begin(thing: str, call: RecordedCall, time: float, state: WorldState) -> Iterator[Handling]:
    """Yield the handling that begins with a call, if it names an arm and a gripper."""
    arm, gripper = (
        next((each for each in call.individuals if state.is_a(each, cls)), None) for cls in (ARM_DEVICE, END_EFFECTOR)
    )
    if arm is not None and gripper is not None:
        yield Handling(thing, arm, gripper, time)


def _end(
    found: list[Handling], thing: str, time: float, calls: Sequence[tuple[float, RecordedCall]], state: WorldState
) -> None:
    """Replace the last handling of a thing by the same with its end, if it has none yet."""
    number = next((i for i in reversed(range(len(found))) if found[i].thing == thing), None)
    if number is None or found[number].released_s is not None:
        return
    held = found[number]
    targets = (_target(call, held.arm) for at, call in calls if held.grasped_s < at < time)
    last = [each for each in targets if each is not None][-1:]
    found[number] = replace(held, released_s=time, target_m=_middle(last[0], thing, state) if last else None)


def _middle(tool: LabelledPose, thing: str, state: WorldState) -> tuple[float, float]:
    """Return the middle (x, y) in m of a held thing whose working face an arm brings to a pose as its tool."""
    at = Pose.of(tool.position_m, tool.quaternion_wxyz)
    with suppress(FrameError):
        at = at @ working_face(size(state, thing)).inverse()
    x, y, _ = at.position.tolist()
    return x, y


def _target(call: RecordedCall, arm: str) -> LabelledPose | None:
    """Return the pose to which a call moves the tool of an arm; None if it does not."""
    target, moved = call.bindings.get(TARGET), call.bindings.get("arm")
    is_pose = isinstance(target, LabelledPose) and isinstance(moved, LabelledIri) and moved.iri == arm
    return target if is_pose and isinstance(target, LabelledPose) else None


class _Move(msgspec.Struct, frozen=True):
    """A write that moved a thing: about the pose of the thing, or of what carries it."""

    thing: str
    moved: str
    write: DecidingWrite


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
    vocabulary, believed, true = state.vocabulary, find_pose(state, thing), _true(truth, thing)
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
