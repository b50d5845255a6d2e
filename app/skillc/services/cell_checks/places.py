"""Checks that things fit into the containers into which they are to be put, and that an arm reaches in."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from types import MappingProxyType
from typing import Final

from skillc_dsl.diagnostics import Severity
from skillc_model.conditions import Condition, Holds, Individual
from skillc_model.traversal import conjuncts
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import moves_with
from skillc_runtime.world.space.grip_force import GraspError
from skillc_runtime.world.space.no_place import Lack, PlaceError
from skillc_runtime.world.space.occupants import Occupant
from skillc_runtime.world.space.place_foresight import place_problem
from skillc_runtime.world.space.placing_poses import find_placing_pose
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.python_calls import InsufficientFacts
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    CONTAIN,
    CONTAINER,
    FIXTURE,
    HAS_GRIPPER,
    LOCATION,
    MANIPULATABLE,
    MOBILE_ROBOT,
    SIZE,
    TRAVEL,
)
from skillc_runtime.world.state.world_state import WorldState

MOST: Final = 50
"""In a scene with more containers or things to handle, only those are checked that a goal names."""

CURES: Final[MappingProxyType[Lack, str]] = MappingProxyType(
    {
        "size": "a thing that is put there would fall",
        "support": "turn it upright",
        "room": "use a larger one, or a smaller thing",
        "free room": "take something out of it, or use a larger one",
        "clearance": "move it, or what is in the way",
        "headroom": "use a place that is open above",
        "reach": "move it nearer to the arm",
    }
)

NAMES: Final[MappingProxyType[Lack, str]] = MappingProxyType({"reach": "out-of-reach", "size": "no-support"})
"""The diagnostics that are not `no-room`."""

UNCERTAIN: Final[tuple[Lack, ...]] = ("free room", "clearance", "size")
"""What may have changed when a thing is put down: what is in a container now, or what stands at a place."""

PLACE_POSE: Final = "skillc_runtime.world.handling:place_pose"


def check_places(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield containers into which none of the things to handle in the cell can be put."""
    things = [each.individual for each in occupants if state.is_a(each.individual, MANIPULATABLE)]
    containers = [each.individual for each in occupants if state.is_a(each.individual, CONTAINER)]
    if not things or max(len(things), len(containers)) > MOST:
        return
    for container in containers:
        problem = None
        for thing in things:
            problem = _find_problem(state, thing, container)
            if problem is None or problem.lack == "free room":
                break
        else:
            if problem is not None:
                yield _violation(container, (), problem, "warning")


def check_goal_places(state: WorldState, goal: Condition) -> Iterator[SceneViolation]:
    """Yield places where the thing cannot be put that shall be there according to a goal.

    Nothing if the library does not put things down by `place_pose`: skills of its own may do it in another way.
    """
    if not any(each.python == PLACE_POSE for each in state.vocabulary.functions.values()):
        return
    for thing, container in _wanted(state, goal):
        problem = _find_problem(state, thing, container)
        if problem is not None:
            yield _violation(container, (thing,), problem, "warning" if problem.lack in UNCERTAIN else "error")


def _wanted(state: WorldState, goal: Condition) -> Iterator[tuple[str, str]]:
    """Yield the things that are elsewhere with the containers in which a goal wants them."""
    for each in conjuncts(goal):
        match each:
            case Holds(subject=Individual(container), relation=relation, object=Individual(thing)):
                known = relation == CONTAIN and {container, thing} <= state.individuals
                sized = known and state.value(thing, SIZE[0]) is not None
                reported = state.is_a(container, CONTAINER) and state.value(container, SIZE[0]) is None
                put_down = sized and not reported and _is_place(state, container) and state.is_a(thing, MANIPULATABLE)
                if put_down and not state.holds(container, CONTAIN, thing):
                    yield thing, container
            case _:
                pass


def _is_place(state: WorldState, individual: str) -> bool:
    """Whether things are put down there, not inserted into it or held by it."""
    return state.is_a(individual, LOCATION) and not state.is_a(individual, FIXTURE)


def _find_problem(state: WorldState, thing: str, container: str) -> PlaceError | None:
    """Return why no arm can put a thing into a container; None if one can, or if that is not known."""
    hands = [(arm, hand) for arm in state.instances(ARM_DEVICE) for hand in state.objects(arm, HAS_GRIPPER)]
    problem: PlaceError | None = None
    try:
        stated = find_placing_pose(state, thing, container)
    except PlaceError as taken:
        return taken
    if stated is not None or state.value(container, TRAVEL) is not None:
        return None
    for arm, hand in sorted(hands):
        with suppress(GraspError):
            try:
                problem = place_problem(state, arm, hand, thing, container)
            except (SheetError, FrameError, InsufficientFacts):
                return None
            if problem is None or (problem.lack == "reach" and (_drives(state, arm) or _drives(state, container))):
                return None
    return problem


def _drives(state: WorldState, individual: str) -> bool:
    return any(moves_with(state, individual, robot) for robot in state.instances(MOBILE_ROBOT))


def _violation(container: str, things: tuple[str, ...], problem: PlaceError, severity: Severity) -> SceneViolation:
    name = NAMES.get(problem.lack, "no-room")
    place = SIZE[0] if problem.lack == "room" else None
    return SceneViolation(container, place, name, str(problem), CURES[problem.lack], severity, things)
