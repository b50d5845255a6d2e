"""Checks that some arm reaches the things to handle, if no arm can be driven to them: by distance, then by postures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc.services.cell_checks.facts import placing_fact, severity_of
from skillc.services.cell_checks.hand_poses import check_postures
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import moves_with, pose
from skillc_runtime.world.space.occupants import Occupant
from skillc_runtime.world.space.reach import Reach, read_reach
from skillc_runtime.world.state.python_calls import InsufficientFacts
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    FIXTURE,
    MANIPULATABLE,
    MOBILE_ROBOT,
    PLACING_POSE,
)
from skillc_runtime.world.state.world_state import WorldState

HANDLED = (MANIPULATABLE, FIXTURE, PLACING_POSE)
"""Classes of what an arm must reach to work."""


def check_reach(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield the things to handle that are out of reach of all arms; none if an arm drives, or is not known."""
    arms = sorted(state.instances(ARM_DEVICE))
    try:
        reaches = [read_reach(state, arm, pose(state, arm)) for arm in arms]
        drives = any(moves_with(state, arm, robot) for arm in arms for robot in state.instances(MOBILE_ROBOT))
    except (FrameError, InsufficientFacts):
        return
    if not reaches or drives:
        return
    far = [each for thing in _things(state, HANDLED) for each in _out_of_reach(state, thing, reaches)]
    yield from far
    yield from check_postures(state, frozenset(each.individual for each in far))


def _things(state: WorldState, classes: Sequence[str]) -> list[str]:
    return sorted({each for cls in classes for each in state.instances(cls)})


def _out_of_reach(state: WorldState, thing: str, reaches: list[Reach]) -> Iterator[SceneViolation]:
    try:
        point = pose(state, thing).position
    except FrameError:
        return
    beyond_m, reach = min(((each.distance_beyond(point[None, :]), each) for each in reaches), key=lambda pair: pair[0])
    if beyond_m <= 0:
        return
    short = state.vocabulary.short
    whom = short(reach.arm) if len(reaches) == 1 else f"every arm; {short(reach.arm)} is the nearest, and it"
    message = f"{short(thing)} is out of reach of {whom} by {beyond_m:.2f} m: it reaches {reach.reach_m:.2f} m"
    place = placing_fact(state, thing)
    cure = f"move it nearer by {beyond_m:.2f} m, or the arm"
    yield SceneViolation(thing, place, "out-of-reach", message, cure, severity_of(beyond_m))
