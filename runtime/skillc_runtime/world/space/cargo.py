"""What a thing carries: what it contains and what rests on it, to any depth; where the thing goes, that goes along."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from skillc_runtime.world.space.bounding_boxes import TOUCH_M
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import attachment_changes, moves_with
from skillc_runtime.world.space.hollow import gap_below
from skillc_runtime.world.space.occupants import Occupant, read_occupants
from skillc_runtime.world.space.whereabouts import holders_of, is_misplaced
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.world_state import WorldState


def find_cargo(state: WorldState, thing: str) -> tuple[tuple[str, str], ...]:
    """Return what a thing carries, each with what carries it directly: the thing itself, or what comes before.

    Things that lie free and have a known place and a size.
    """
    loads = {each.individual: each for each in read_occupants(state) if each.movable}
    bearers, found = [thing], dict[str, str]()
    for bearer in bearers:
        for each in loads.values():
            if each.individual not in (thing, *found) and _carries(state, bearer, loads, each):
                found[each.individual] = bearer
                bearers.append(each.individual)
    return tuple(found.items())


def cargo_changes(state: WorldState, thing: str) -> list[Change]:
    """Return the changes with which all that a thing carries moves with it from now on; nothing moves by them."""
    return [change for each, bearer in find_cargo(state, thing) for change in _attach(state, each, bearer)]


def lies_on(state: WorldState, upper: str, lower: str) -> bool:
    """Whether a thing lies on another, to 5 mm; False if where they are is not known."""
    try:
        gap = gap_below(state, upper, lower)
    except FrameError:
        return False
    return gap is not None and abs(gap) <= TOUCH_M


def _carries(state: WorldState, bearer: str, loads: dict[str, Occupant], load: Occupant) -> bool:
    if is_misplaced(state, load.individual):
        return False
    if bearer in holders_of(state, load.individual):
        return True
    below = loads.get(bearer)
    near = below is None or bool((load.low <= below.high + TOUCH_M).all() and (load.high >= below.low).all())
    return near and lies_on(state, load.individual, bearer)


def _attach(state: WorldState, thing: str, bearer: str) -> Iterator[Change]:
    with suppress(FrameError):
        if not moves_with(state, thing, bearer):
            yield from attachment_changes(state, thing, bearer)
