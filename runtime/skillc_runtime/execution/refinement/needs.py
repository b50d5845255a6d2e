"""Looks for ways in which a primitive gets what it needs of space: the best first."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain, islice
from typing import Generic, TypeAlias, TypeVar, assert_never

import numpy as np

from skillc_runtime.collision.collision_checker import Collision
from skillc_runtime.collision.path_planning import NoPath, plan_joint_path
from skillc_runtime.execution.refinement.arm_view import ArmView, recall, view_arm
from skillc_runtime.execution.refinement.failure import SpaceFailure
from skillc_runtime.execution.refinement.situation import Situation
from skillc_runtime.execution.refinement.standing import list_stands
from skillc_runtime.kinematics.chain import pack
from skillc_runtime.kinematics.inverse import APART_RAD, find_posture, find_postures, rank_postures, spread_seeds
from skillc_runtime.kinematics.sweep import (
    ERROR_M,
    ERROR_RAD,
    FAR_M,
    FAR_RAD,
    TORQUE,
    Sweep,
    follow,
    sample_poses,
)
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.primitives.planned_postures import find_planned
from skillc_runtime.primitives.space_needs import (
    Follow,
    Hold,
    Leave,
    Open,
    Press,
    PutFlange,
    Reach,
    SpaceNeed,
    Stand,
    Take,
    ToolOffsets,
)
from skillc_runtime.world.space.cargo import cargo_changes, find_cargo, lies_on
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import frame_name, pose, put_down_changes, relocation_changes, size
from skillc_runtime.world.space.grasping.grasp_geometry import is_sideways
from skillc_runtime.world.space.grasping.grip_force import find_excess_load, mass_of
from skillc_runtime.world.space.hollow import gap_below
from skillc_runtime.world.space.occupants import read_occupants
from skillc_runtime.world.space.placing.chosen_places import end_of_reservation
from skillc_runtime.world.space.whereabouts import holders_of
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import HELD_SIDEWAYS
from skillc_runtime.world.state.world_state import WorldState

T = TypeVar("T")


class LazyList(Generic[T]):
    """The items of an iterator, each taken from it once; several may go through it at the same time."""

    def __init__(self, items: Iterator[T]) -> None:
        self._items, self._known = items, list[T]()

    def __iter__(self) -> Iterator[T]:
        place = 0
        while True:
            if place == len(self._known):
                try:
                    self._known.append(next(self._items))
                except StopIteration:
                    return
            yield self._known[place]
            place += 1


Outcome: TypeAlias = Situation | SpaceFailure

SAMPLE_M = 0.02
"""The distance of poses along a path of the tool that are looked at."""

LOOKED_AT = 64
"""How many postures of a pose are looked at. A run that takes none of them tries fewer, `move.MOST_POSTURES`."""

ELBOWS, ELBOW_SEEDS = 48, 8
"""Towards how many other postures the elbow of a redundant arm is pulled where the first ones do not go, and from how
many starts each."""

LOWERED_M = 0.03
"""How far a thing is lowered at most until it stands on something."""

AIMLESS = np.zeros(3)


def meet(need: SpaceNeed, here: Situation) -> Iterator[Outcome]:
    """Yield the situations in which a need is met, the best first, and why other ways do not go.

    FrameError or SheetError if facts are missing.
    """
    match need:
        case Reach(arm=arm, tool=tool):
            yield from _reach(view_arm(here, arm), tool, here)
        case PutFlange(arm=arm, flanges=flanges):
            yield from _put_flange(view_arm(here, arm), flanges, here)
        case Take(arm=arm, q=q):
            yield _take(view_arm(here, arm), q, here)
        case Follow(arm=arm, poses=poses):
            yield _follow(view_arm(here, arm), poses, here)
        case Press(arm=arm, force=force):
            yield replace(here, forces={**here.forces, arm: force})
        case ToolOffsets(arm=arm, offsets=offsets):
            yield replace(here, spreads={**here.spreads, arm: offsets})
        case Open(gripper=gripper, opening_m=opening_m):
            yield replace(here, openings={**here.openings, gripper: opening_m})
        case Hold():
            yield _hold(need, here)
        case Leave():
            yield _leave(need, here)
        case Stand():
            yield from list_stands(need, here)
        case _:
            assert_never(need)


def _reach(view: ArmView, tool: Pose, here: Situation) -> Iterator[Outcome]:
    target = view.base.inverse() @ tool
    planned = find_planned(here.planned, view.arm, tool)
    as_planned = None if planned is None else find_posture(view.chain, target, view.free_range, planned)
    if as_planned is not None:
        yield _take(view, as_planned, here, tool)
        return
    key = ("postures", view.arm, view.chain.frames.tobytes(), view.chain.tool.tobytes(), pack(target).tobytes())
    none = True
    for q in recall(here, key, lambda: LazyList(_list_postures(view, target))):
        none = False
        yield _take(view, q, here, tool)
    if none:
        what, at = _name_tool(view, tool, here)
        yield SpaceFailure("out-of-reach", f"no posture of {_name(view, here)} brings {what} to {_place(at)}")


def _name_tool(view: ArmView, tool: Pose, here: Situation) -> tuple[str, Pose]:
    """Return what is brought to a pose of the tool: a thing that is held, and where its middle is then, or the tool."""
    if view.held is None:
        return "its tool", tool
    return here.state.vocabulary.short(view.held), tool @ working_face(size(here.state, view.held)).inverse()


def _list_postures(view: ArmView, target: Pose) -> Iterator[Array]:
    """Yield the postures (nv,) in rad with the tool at a target in the base that are looked at, the best first."""
    found = rank_postures(view.chain, target, view.free_range, view.home)
    yield from islice(chain(found, _other_elbows(view, target, found)), LOOKED_AT)


def _put_flange(view: ArmView, flanges: tuple[Pose, ...], here: Situation) -> Iterator[Outcome]:
    chain_, inward, reached = view.flange_chain, view.base.inverse(), 0
    for each in flanges:
        q = find_posture(chain_, inward @ each, view.free_range, view.home)
        if q is not None:
            reached += 1
            yield _take(view, q, here)
        if reached == LOOKED_AT:
            return
    if not reached:
        why = f"no posture of {_name(view, here)} lets the camera on its flange see that, as from {_place(flanges[0])}"
        yield SpaceFailure("out-of-reach", why)


def _other_elbows(view: ArmView, target: Pose, known: Array) -> Iterator[Array]:
    """Yield more postures (nv,) in rad of a redundant arm with its tool at a target in its base, apart from the known.

    Those that are known are the nearest to home on their branches.
    """
    if view.chain.joints <= 6:
        return
    found = list(known)
    for rest in spread_seeds(view.chain.slides, view.free_range, view.home, ELBOWS):
        for q in find_postures(view.chain, target, view.free_range, rest, ELBOW_SEEDS):
            if all(float(np.abs(q - each).max()) > APART_RAD for each in found):
                found.append(q)
                yield q


def _take(view: ArmView, q: Array, here: Situation, tool: Pose | None = None) -> Outcome:
    """Return the situation after a motion of the joints to a posture (nv,) in rad, or what is in its way.

    `tool` is as in `RefinedMotion`.
    """
    try:
        way = plan_joint_path(view.checker, view.q, [q], view.space)
    except NoPath as why:
        touch = view.checker.find_collision(q)
        return SpaceFailure("no-path" if touch is None else "in-the-way", str(why))
    return here.with_motion(view.move(way, along=False, tool=tool))


def _follow(view: ArmView, poses: tuple[Pose, ...], here: Situation) -> Outcome:
    """Return the situation after the tool has followed lines through poses in the world, or why it cannot."""
    inward = view.base.inverse()
    corners = [inward @ each for each in (view.tool, *poses)]
    offsets = here.spreads.get(view.arm)
    local = None if offsets is None else offsets @ view.base.rotation
    sampled = sample_poses(corners, SAMPLE_M, local)
    load = view.load(here.forces.get(view.arm, AIMLESS))
    sweep = follow(view.chain, sampled, view.q, load)
    if not sweep.reached.all():
        return _explain(view, sweep, sampled, here)
    touch = view.checker.find_overlap(view.q, sweep.postures, view.movable)
    if touch is not None:
        return _overlap(touch)
    return here.with_motion(view.move(tuple(sweep.postures), along=True))


def _explain(view: ArmView, sweep: Sweep, sampled: Array, here: Situation) -> SpaceFailure:
    """Return why the first pose of a path that is not reached is not."""
    first = int(np.argmin(sweep.reached))
    q, measured = sweep.postures[first], sweep.measures[first]
    at = _place(view.base @ Pose(sampled[first, :3], np.eye(3)))
    if measured[ERROR_M] > FAR_M or measured[ERROR_RAD] > FAR_RAD:
        return SpaceFailure("out-of-reach", f"the tool of {_name(view, here)} does not get to {at}")
    limits = view.space.range
    outside = np.maximum(limits[:, 0] - q, q - limits[:, 1])
    joint = int(outside.argmax())
    if outside[joint] > 0.0:
        low, high = limits[joint]
        why = f"joint {joint + 1} would be at {q[joint]:.2f}, outside its range from {low:.2f} to {high:.2f}, at {at}"
        return SpaceFailure("joint-range", f"{_name(view, here)}: {why}")
    share = float(measured[TORQUE])
    why = f"a joint of {_name(view, here)} would need {share:.0%} of its greatest torque at {at}"
    return SpaceFailure("torque", why)


def _overlap(touch: Collision) -> SpaceFailure:
    why = f"on the way of the tool {touch} and overlap it by {-1e3 * touch.distance_m:.0f} mm"
    return SpaceFailure("in-the-way", why)


def _hold(need: Hold, here: Situation) -> Outcome:
    """Return the situation with a thing in the hand, or that it is too heavy with its load, or what lies on it."""
    state = here.state
    above = next(_lying_on(here, need.thing), None)
    if above is not None:
        short = state.vocabulary.short
        why = f"{short(above)} lies on {short(need.thing)}, which is to be moved"
        return SpaceFailure("in-the-way", why, in_any_posture=True)
    load = (need.thing, *(each for each, _ in find_cargo(state, need.thing)))
    too_much = find_excess_load(state, need.gripper, need.thing, sum(mass_of(state, each) for each in load))
    if too_much is not None:
        return SpaceFailure("torque", too_much, in_any_posture=True)
    in_hand = need.at.inverse() @ pose(state, need.thing)
    held = relocation_changes(state, need.thing, in_hand, frame_name(state, need.gripper))
    sideways = SetProperty(need.thing, HELD_SIDEWAYS, is_sideways(need.at))
    return here.with_changes([*cargo_changes(state, need.thing), *held, sideways])


def _leave(need: Leave, here: Situation) -> Outcome:
    """Return the situation after the arm has lowered a thing until it stands, and let it go there."""
    view, state = view_arm(here, need.arm), here.state
    left_at = view.tool @ working_face(size(state, need.thing)).inverse()
    there = here.with_changes(put_down_changes(state, need.thing, left_at, need.to))
    lower = np.array([0.0, 0.0, -_gap_m(there, need.thing)])
    lowered = _follow(view, (Pose(view.tool.position + lower, view.tool.rotation),), here)
    if isinstance(lowered, SpaceFailure):
        return lowered
    left = put_down_changes(state, need.thing, Pose(left_at.position + lower, left_at.rotation), need.to)
    return lowered.with_changes([*left, *end_of_reservation(state, need.thing, need.to)])


def _lying_on(here: Situation, thing: str) -> Iterator[str]:
    """Yield the things that lie on a thing which does not contain, and so carry, them."""
    for each in read_occupants(here.state):
        if not each.movable or each.individual == thing or thing in holders_of(here.state, each.individual):
            continue
        if lies_on(here.state, each.individual, thing):
            yield each.individual


def _known_gap(state: WorldState, upper: str, lower: str) -> float | None:
    """Return how far one thing is above another one, in m; None if it is not above it, or that is not known."""
    try:
        return gap_below(state, upper, lower)
    except FrameError:
        return None


def _gap_m(here: Situation, thing: str) -> float:
    """Return how far a thing is above what it comes to stand on, in m, at most LOWERED_M; 0 if that is not known."""
    others = (each.individual for each in read_occupants(here.state) if each.individual != thing)
    gaps = (_known_gap(here.state, thing, other) for other in others)
    least = min((gap for gap in gaps if gap is not None and gap >= 0.0), default=LOWERED_M)
    return least if least < LOWERED_M else 0.0


def _name(view: ArmView, here: Situation) -> str:
    return here.state.vocabulary.short(view.arm)


def _place(at: Pose) -> str:
    x, y, z = at.position
    return f"({x:.2f}, {y:.2f}, {z:.2f}) m"
