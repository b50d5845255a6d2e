"""Checks that things fit into the containers into which they are to be put, and that an arm reaches in."""

from __future__ import annotations

from collections.abc import Iterator
from types import MappingProxyType
from typing import Final

from skillc_dsl.diagnostics import Severity
from skillc_model.conditions import Condition
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.occupants import Occupant
from skillc_runtime.world.space.placing.no_place import Lack, PlaceError
from skillc_runtime.world.space.placing.place_foresight import find_place_problem, list_wanted, uses_place_pose
from skillc_runtime.world.state.terms import (
    CONTAINER,
    MANIPULATABLE,
    SIZE,
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


def check_places(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield containers into which none of the things to handle in the cell can be put."""
    things = [each.individual for each in occupants if state.is_a(each.individual, MANIPULATABLE)]
    containers = [each.individual for each in occupants if state.is_a(each.individual, CONTAINER)]
    if not things or max(len(things), len(containers)) > MOST:
        return
    for container in containers:
        problem = None
        for thing in things:
            problem = find_place_problem(state, thing, container)
            if problem is None or problem.lack == "free room":
                break
        else:
            if problem is not None:
                yield _violation(container, (), problem, "warning")


def check_goal_places(state: WorldState, goal: Condition) -> Iterator[SceneViolation]:
    """Yield places where the thing cannot be put that shall be there according to a goal.

    Nothing if the library does not put things down by `place_pose`: skills of its own may do it in another way.
    """
    if not uses_place_pose(state):
        return
    for thing, container in list_wanted(state, goal):
        problem = find_place_problem(state, thing, container)
        if problem is not None:
            yield _violation(container, (thing,), problem, "warning" if problem.lack in UNCERTAIN else "error")


def _violation(container: str, things: tuple[str, ...], problem: PlaceError, severity: Severity) -> SceneViolation:
    name = NAMES.get(problem.lack, "no-room")
    place = SIZE[0] if problem.lack == "room" else None
    return SceneViolation(container, place, name, str(problem), CURES[problem.lack], severity, things)
