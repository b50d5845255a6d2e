"""Finds a place nearby for a thing with which a step that does not go in space goes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import product

from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.cancellation import Cancelled, CancelToken, cancelling
from skillc_runtime.collision.solid_geoms import find_overlap_m
from skillc_runtime.execution.refinement.failure import SpaceFailure
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.occupants import read_occupants
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.terms import OFFSET, POSITION
from skillc_runtime.world.state.world_state import WorldState

DISTANCES_M = (0.05, 0.1, 0.15, 0.2)
"""How far away places are that are tried, in each direction of the numbers that say where the thing is."""

ROOM_M = 0.02
"""How far from the place that is proposed the thing may be, along each of these numbers, so that all still goes."""


def find_cure(
    state: WorldState,
    things: Iterable[str],
    failure: SpaceFailure,
    goes: Callable[[WorldState], bool],
    cancel: CancelToken,
) -> str:
    """Return with which place of a thing all goes, as a sentence: of the first of some things that stands somewhere.

    Before it comes what a failure says to be in the way. All goes as well with the thing up to ROOM_M from there.
    Places are tried from the nearest on, and those left out at which it would lie deeper in another thing. Empty if
    none was found before `cancel` ends the search.
    """
    standing = [each.individual for each in read_occupants(state) if any(_numbers(state, each.individual))]
    given = [each for each in things if each in standing][:1]
    words = {each.rstrip(".,;:") for each in failure.why.split()} if failure.cause == "in-the-way" else set[str]()
    blocking = [each for each in dict.fromkeys(standing) if state.vocabulary.short(each) in words and each not in given]
    try:
        with cancelling(cancel):
            return next(filter(None, (_find_place(state, each, goes) for each in (*blocking, *given))), "")
    except Cancelled:
        return ""


def _find_place(state: WorldState, thing: str, goes: Callable[[WorldState], bool]) -> str:
    short, before_m = state.vocabulary.short(thing), find_overlap_m(state, thing)
    for distance_m, (name, stated_m), sign in product(DISTANCES_M, tuple(_numbers(state, thing)), (1.0, -1.0)):
        to_m = round(stated_m + sign * distance_m, 4)
        there = _moved(state, thing, name, to_m)
        if there is not None and find_overlap_m(there, thing) <= before_m and _goes_about(there, thing, goes):
            return f"with {short} moved by {distance_m:g} m, to {local_name(name)} {to_m:g}, all steps go"
    return ""


def _goes_about(state: WorldState, thing: str, goes: Callable[[WorldState], bool]) -> bool:
    """Whether all goes where a thing is, and with it a little to each side."""
    if not goes(state):
        return False
    beside = (
        _moved(state, thing, name, stated_m + way_m)
        for name, stated_m in _numbers(state, thing)
        for way_m in (ROOM_M, -ROOM_M)
    )
    return all(there is not None and goes(there) for there in beside)


def _numbers(state: WorldState, thing: str) -> Iterator[tuple[str, float]]:
    """Yield the properties that say where a thing is along an axis, in m."""
    for name in (*POSITION, *OFFSET):
        value = state.value(thing, name)
        if isinstance(value, int | float):
            yield name, float(value)


def _moved(state: WorldState, thing: str, name: str, to_m: float) -> WorldState | None:
    try:
        return WorldModel(state).commit([SetProperty(thing, name, to_m)]).after
    except (WorldError, FrameError):
        return None
