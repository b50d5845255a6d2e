"""Checks that things to handle have a body: a size, and a shape of that size."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.bodies import has_body, read_body
from skillc_runtime.world.space.frame_tree import FrameError, frame_tree_of
from skillc_runtime.world.space.frames import states_own_pose
from skillc_runtime.world.space.occupants import Occupant
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    CONTAINER,
    END_EFFECTOR,
    HAS_A,
    HAS_SHEET,
    MANIPULATABLE,
    SHAPE,
    SIZE,
)
from skillc_runtime.world.state.world_state import WorldState

WITHOUT_POSE = "no-pose"
"""The problem because of which nothing else can be said about where a thing is."""


def check_bodies(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield things to handle and containers without a size if there is an arm, and impossible sizes and shapes."""
    handled = {*state.instances(MANIPULATABLE), *state.instances(CONTAINER)} if _has_devices(state) else set[str]()
    sized = {each for name in SIZE if name in state.stored for each, _ in state.stored[name].items()}
    for individual in sorted(handled - sized):
        if not _has_model(state, individual):
            yield _without_size(state, individual)
    for individual in sorted(sized & handled):
        yield from _without_pose(state, individual)
    for individual in sorted(sized):
        yield from _impossible(state, individual)


def _has_devices(state: WorldState) -> bool:
    """Whether there is an arm that can be simulated; else things may be there to plan with only."""
    return HAS_SHEET in state.facts and any(state.objects(arm, HAS_SHEET) for arm in state.instances(ARM_DEVICE))


def _has_model(state: WorldState, individual: str) -> bool:
    """Whether a thing is simulated or used without a size: it has a data sheet, or poses say where to put things."""
    return any(relation in state.facts and state.objects(individual, relation) for relation in (HAS_SHEET, HAS_A))


def _without_size(state: WorldState, individual: str) -> SceneViolation:
    short = state.vocabulary.short
    classes = " and ".join(sorted(map(short, state.types(individual))))
    if state.is_a(individual, MANIPULATABLE):
        what = "so it has no body: it cannot be simulated or grasped"
    else:
        what = "so it has no body: nothing can be put into it"
    cure = " ".join(f"`{short(name)} NUMBER-IN-m ;`" for name in SIZE)
    message = f"{short(individual)}, a {classes}, has no size, {what}"
    return SceneViolation(individual, None, "no-body", message, f"write {cure}")


def _without_pose(state: WorldState, individual: str) -> Iterator[SceneViolation]:
    """Yield a thing that is only said to be in or at something: its body would be in the middle of that."""
    try:
        carrier = None if states_own_pose(state, individual) else frame_tree_of(state).carrier(individual)
    except FrameError:
        return
    if carrier is None or state.is_a(carrier, END_EFFECTOR):
        return
    short = state.vocabulary.short
    message = f"{short(individual)} has no pose, so it would be in the middle of {short(carrier)}"
    yield SceneViolation(individual, None, WITHOUT_POSE, message, "write what it is on, `skillc:on THING ;`, or a pose")


def _impossible(state: WorldState, individual: str) -> Iterator[SceneViolation]:
    if not has_body(state, individual):
        return
    try:
        read_body(state, individual)
    except (SheetError, FrameError) as error:
        short = state.vocabulary.short
        lost = [name for name in SIZE if state.value(individual, name) is None]
        numbers = " ".join(f"`{short(name)} NUMBER-IN-m ;`" for name in lost)
        cure = f"write {numbers}" if lost else "correct its size, or write another shape"
        place = SHAPE if state.value(individual, SHAPE) is not None else _first_size(state, individual)
        yield SceneViolation(individual, place, "impossible-body", str(error), cure)


def _first_size(state: WorldState, individual: str) -> str:
    return next(name for name in SIZE if state.value(individual, name) is not None)
