"""What is known of a thing that is not where it was believed to be: no longer what it is in, on or beside.

Its last known pose is kept, so that it can be looked for there; `skillc:located` is false, which says that it is no
more than that. What is left is an assumption: it is somewhere in the area in which a robot works.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from skillc_runtime.world.space.frame_tree import WORLD_FRAME, FrameError
from skillc_runtime.world.space.frames import pose, relocation_changes
from skillc_runtime.world.state.changes import AddRelation, Change, ClearProperty, RemoveRelation, SetProperty
from skillc_runtime.world.state.terms import (
    AT,
    BASE_FRAME_ID,
    CONTAIN,
    HAS_A,
    INSERTED_DEPTH,
    IS_SEATED,
    LOCATED,
    ON,
    WORKSTATION,
)

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


def is_misplaced(state: WorldState, thing: str) -> bool:
    """Whether it was measured that a thing is not where it was believed to be, and not where it is."""
    return LOCATED in state.stored and state.value(thing, LOCATED) is False


def unknown_place(state: WorldState, *things: str) -> str | None:
    """Return that it is not known where the first of some things is of which that is so; None for none."""
    misplaced = next((each for each in things if is_misplaced(state, each)), None)
    return None if misplaced is None else f"it is not known where {state.vocabulary.short(misplaced)} is"


def displacement_changes(state: WorldState, thing: str, at: str | None = None) -> list[Change]:
    """Return the changes that withdraw where a thing is: what contains it, what it is on, and how deep it sits there.

    The area in which a robot works may still contain it, unless it is the place `at` where the thing was looked for: a
    measurement at one spot does not contradict that.
    """
    held = [RemoveRelation(each, CONTAIN, thing) for each in _holders(state, thing, at)]
    laid = [RemoveRelation(thing, ON, each) for each in _linked(state, thing, ON)]
    seated = (each for each in (IS_SEATED, INSERTED_DEPTH) if each in state.stored)
    cleared = [ClearProperty(thing, each) for each in seated if state.value(thing, each) is not None]
    lost = [SetProperty(thing, LOCATED, False)] if LOCATED in state.vocabulary.properties else []
    return [*held, *laid, *cleared, *lost]


def last_known_changes(before: WorldState, after: WorldState, thing: str) -> list[Change]:
    """Return the changes after which a thing is in the world where it was `before` it was withdrawn from something.

    None if it was not, if its pose does not follow from that, or if its pose was not known.
    """
    laid = _linked(before, thing, ON)
    left = laid != _linked(after, thing, ON) or holders_of(before, thing) != holders_of(after, thing)
    if not left or (before.value(thing, BASE_FRAME_ID) == WORLD_FRAME and not laid):
        return []
    with suppress(FrameError):
        changes = relocation_changes(before, thing, pose(before, thing))
        return [each for each in changes if not isinstance(each, RemoveRelation)]
    return []


def search_changes(state: WorldState, thing: str, near: Iterable[str], at: str | None = None) -> list[Change]:
    """Return the change that assumes a thing which nothing contains in the area around other things.

    None if something contains it, or if no area but the place `at`, where it is not, is known.
    """
    if holders_of(state, thing):
        return []
    areas = _areas(state) - {at}
    around = (each for inner in near for each in _outwards(state, inner))
    area = next((each for each in around if each in areas), None)
    return [] if area is None else [AddRelation(area, CONTAIN, thing)]


def holders_of(state: WorldState, thing: str) -> list[str]:
    """Return what contains a thing: one at most, where containing is functional; nothing without that relation."""
    return _linked(state, thing, CONTAIN, backward=True)


def _holders(state: WorldState, thing: str, at: str | None) -> list[str]:
    """Return what contains a thing, but for areas in which robots work that are not the place `at`."""
    areas = _areas(state) - {at}
    return [each for each in holders_of(state, thing) if each not in areas]


def _areas(state: WorldState) -> frozenset[str]:
    """Return the places in which robots work: workstations, and where a robot is."""
    occupied = (place for _, place in state.pairs(AT)) if AT in state.facts else ()
    return state.instances(WORKSTATION) | frozenset(occupied)


def _outwards(state: WorldState, near: str) -> Iterator[str]:
    """Yield something, then what it is in, a part of or at, and so on."""
    seen, waiting = set[str](), [near]
    while waiting:
        each = waiting.pop(0)
        if each not in seen:
            seen.add(each)
            yield each
            around = (_linked(state, each, relation, backward=True) for relation in (CONTAIN, HAS_A))
            waiting += [*(outer for outers in around for outer in outers), *_linked(state, each, AT)]


def _linked(state: WorldState, individual: str, relation: str, *, backward: bool = False) -> list[str]:
    """Return what an individual has a relation to, or what has it to the individual; nothing without the relation."""
    if relation not in state.facts:
        return []
    links = state.facts[relation]
    return sorted((links.backward if backward else links.forward).get(individual))
