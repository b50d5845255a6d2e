"""Compares what the world model claims about things with where they really are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import degrees

import msgspec
import numpy as np

from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bodies import RigidBody
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.shape.oriented_box import OrientedBox
from skillc_runtime.world.space.shape.shapes import Bin, Sphere
from skillc_runtime.world.state.terms import CONTAIN, END_EFFECTOR, HAS_GRIPPER, LOCATED
from skillc_runtime.world.state.world_state import WorldState

POSITION_TOLERANCE_M = 0.05
"""A claimed position is false if the thing is farther away from it than this."""

TILT_TOLERANCE_DEG = 30.0
"""A claimed orientation is false if the z axis of the thing is turned by more than this: it has fallen over."""

REST_M = 0.01
"""How far above what it lies on, or inside it, the lowest point of a thing may be."""


class TrueBody(msgspec.Struct, frozen=True, eq=False):
    """A body where it really is: its pose in the world, and its bounding box there."""

    body: RigidBody
    at: Pose
    box: OrientedBox


def find_false_claims(bodies: Sequence[RigidBody], state: WorldState, truth: GroundTruth) -> tuple[str, ...]:
    """Return what the world model claims of what is where, and who holds what, that is not so; a sentence each.

    `bodies` are those of the world with which the cell was built. A claim about what has no body is not judged.
    """
    real = {each.individual: place_body(each, truth.body_pose(each.individual)) for each in bodies}
    return (*_false_grasps(real, state, truth), *_false_places(real, state, truth))


def place_body(body: RigidBody, at: Pose) -> TrueBody:
    """Return a body at a pose in the world."""
    reach = [np.abs(each.place.rotation) @ np.array(each.half) for each in body.solids]
    pairs = list(zip(body.solids, reach, strict=True))
    low = np.min([solid.place.position - half for solid, half in pairs], axis=0)
    high = np.max([solid.place.position + half for solid, half in pairs], axis=0)
    return TrueBody(body, at, OrientedBox.of(at @ Pose((low + high) / 2, np.eye(3)), (high - low) / 2))


def is_in(thing: TrueBody, holder: TrueBody, others: Sequence[TrueBody] = ()) -> bool:
    """Whether a thing is really in or on a holder: its middle over it, its lowest point within it or on its top.

    It may also lie on one of the `others` that are in the holder.
    """
    local = holder.box.middle.inverse().apply(thing.box.middle.position)
    room = holder.box.half - (holder.body.shape.wall_m if isinstance(holder.body.shape, Bin) else 0.0)
    if (np.abs(local[:2]) > room[:2]).any():
        return False
    bottom, top = (holder.box.middle.position[2] + side * holder.box.half[2] for side in (-1, 1))
    stacked = any(_lies_on(thing, each) for each in others)
    return bool(bottom - REST_M <= thing.box.lowest and (stacked or thing.box.lowest <= top + REST_M))


def _false_grasps(real: Mapping[str, TrueBody], state: WorldState, truth: GroundTruth) -> Iterator[str]:
    short = state.vocabulary.short
    for gripper in _grippers(state, truth):
        claimed, held = sorted(state.objects(gripper, CONTAIN)), truth.carried_by(gripper)
        for thing in claimed:
            if thing != held:
                place = _describe_place(real, truth, state, thing) if thing in real else "is not held"
                yield f"{short(thing)} is claimed in {short(gripper)} but {place}"
        if held is not None and held not in claimed:
            yield f"{short(gripper)} is not claimed to hold {short(held)} but does"


def _false_places(real: Mapping[str, TrueBody], state: WorldState, truth: GroundTruth) -> Iterator[str]:
    for drawer in (name for name, each in real.items() if each.body.slide is not None):
        yield from _false_pose(real, truth, state, drawer)
    for thing in (name for name, each in real.items() if each.body.movable):
        holders = [each for each in sorted(state.subjects(CONTAIN, thing)) if each != thing]
        if any(state.is_a(each, END_EFFECTOR) for each in holders):
            continue
        missed = [each for each in holders if each in real and not _is_contained(real, state, thing, each)]
        if missed:
            yield _describe_missed(real, truth, state, thing, missed[0])
        else:
            yield from _false_pose(real, truth, state, thing)


def _is_contained(real: Mapping[str, TrueBody], state: WorldState, thing: str, holder: str) -> bool:
    beside = [real[each] for each in state.objects(holder, CONTAIN) if each in real and each != thing]
    return is_in(real[thing], real[holder], beside)


def _false_pose(real: Mapping[str, TrueBody], truth: GroundTruth, state: WorldState, thing: str) -> Iterator[str]:
    if state.value(thing, LOCATED) is False:
        return  # its pose is only where it was last, and nothing is claimed
    try:
        believed = pose(state, thing)
    except FrameError:
        return
    name, true = state.vocabulary.short(thing), real[thing]
    apart = float(np.linalg.norm(true.at.position - believed.position))
    tilt = degrees(float(np.arccos(np.clip(believed.rotation[:, 2] @ true.at.rotation[:, 2], -1.0, 1.0))))
    if apart > POSITION_TOLERANCE_M:
        place = _describe_place(real, truth, state, thing)
        yield f"{name} is claimed at {_coordinates(believed.position)} but {place}, {apart:.2f} m away"
    elif tilt > TILT_TOLERANCE_DEG and not isinstance(true.body.shape, Sphere):
        yield f"{name} has fallen over: it is tilted by {tilt:.0f} deg against its claimed pose"


def _describe_missed(
    real: Mapping[str, TrueBody], truth: GroundTruth, state: WorldState, thing: str, holder: str
) -> str:
    short = state.vocabulary.short
    place = _describe_place(real, truth, state, thing)
    return f"{short(thing)} is claimed in {short(holder)} but {place}, {_gap_m(real[thing], real[holder]):.2f} m away"


def _describe_place(real: Mapping[str, TrueBody], truth: GroundTruth, state: WorldState, thing: str) -> str:
    """Return where a thing really is, as the end of a sentence about it."""
    short, at = state.vocabulary.short, real[thing]
    for gripper in _grippers(state, truth):
        if truth.carried_by(gripper) == thing:
            return f"is held by {short(gripper)}"
    for name, each in sorted(real.items(), key=lambda item: (not isinstance(item[1].body.shape, Bin), item[0])):
        if name != thing and isinstance(each.body.shape, Bin) and is_in(at, each):
            return f"lies in {short(name)}"
        if name != thing and _lies_on(at, each):
            return f"lies on {short(name)}"
    if at.box.lowest < REST_M:
        return "lies on the floor"
    return f"is at {_coordinates(at.at.position)}"


def _grippers(state: WorldState, truth: GroundTruth) -> list[str]:
    """Return the grippers that arms have: others are not simulated, nor those that came after the cell was built."""
    return sorted(each for each in {gripper for _, gripper in state.pairs(HAS_GRIPPER)} if _is_simulated(each, truth))


def _is_simulated(gripper: str, truth: GroundTruth) -> bool:
    try:
        truth.carried_by(gripper)
    except KeyError:
        return False
    return True


def _lies_on(thing: TrueBody, other: TrueBody) -> bool:
    x, y, _ = thing.box.middle.position.tolist()
    top = other.box.height_at(x, y)
    return top is not None and abs(thing.box.lowest - top) < REST_M


def _gap_m(thing: TrueBody, holder: TrueBody) -> float:
    """Return the distance in m from the middle of a thing to the bounding box of a holder."""
    local = holder.box.middle.inverse().apply(thing.box.middle.position)
    return float(np.linalg.norm(np.maximum(np.abs(local) - holder.box.half, 0.0)))


def _coordinates(position: Array) -> str:
    return " ".join(f"{each:.2f}" for each in position)
