"""What a scene must say to be a place, beyond the axioms: frames lead to the map, turns turn, sizes are positive."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from math import hypot

from skillc_runtime.world.frames import WORLD_FRAME
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.terms import (
    ARM_DEVICE,
    AT,
    BASE_FRAME_ID,
    FRAME_ID,
    GRASP_WIDTH,
    HAS_SHEET,
    ORIENTATION,
    SIZE,
    WEIGHT,
)
from skillc_runtime.world.turtle import RDF_TYPE

POSITIVE = (*SIZE, WEIGHT, GRASP_WIDTH)
LEAST_NORM, GREATEST_NORM = 1e-6, 1e6


@dataclass(frozen=True, slots=True)
class Flaw:
    """What is implausible: the statement (its individual and predicate, IRIs), a name, words, and what to do."""

    individual: str
    predicate: str
    name: str
    message: str
    help: str = ""


def flaws(state: WorldState) -> Iterator[Flaw]:
    """Yield all that is implausible in a world; rules about terms that its vocabulary lacks find nothing."""
    for rule in (_unknown_frames, _circles, _turns, _sizes, _sheets):
        yield from rule(state)


def _unknown_frames(state: WorldState) -> Iterator[Flaw]:
    owners, short = _owners(state), state.vocabulary.short
    for individual, base in _stored(state, BASE_FRAME_ID):
        found = owners.get(str(base), [])
        if base == WORLD_FRAME or len(found) == 1:
            continue
        reason = f"{' and '.join(map(short, found))} have this FrameId" if found else "nothing has this FrameId"
        near = get_close_matches(str(base), [WORLD_FRAME, *owners], n=1)
        cure = f"did you mean `{near[0]}`?" if near else f"there is {', '.join(sorted([WORLD_FRAME, *owners]))}"
        message = f"{short(individual)} is placed in the frame `{base}`, but {reason}"
        yield Flaw(individual, BASE_FRAME_ID, "unknown-frame", message, "give each its own" if found else cure)


def _circles(state: WorldState) -> Iterator[Flaw]:
    parents, reported = _parents(state), set[str]()
    for individual, _ in _stored(state, BASE_FRAME_ID):
        path, at = [individual], parents.get(individual)
        while at is not None and at not in path:
            path.append(at)
            at = parents.get(at)
        if at == individual and reported.isdisjoint(path):
            reported.update(path)
            names = " and ".join(map(state.vocabulary.short, path))
            message = f"the frames of {names} form a circle" if len(path) > 1 else f"{names} is placed in its own frame"
            yield Flaw(individual, BASE_FRAME_ID, "frame-circle", message, f"place one of them in `{WORLD_FRAME}`")


def _turns(state: WorldState) -> Iterator[Flaw]:
    parts = [dict(_stored(state, name)) for name in ORIENTATION]
    for individual in parts[0]:
        numbers = [value for part in parts if isinstance(value := part.get(individual), int | float)]
        if len(numbers) == len(parts) and not LEAST_NORM < hypot(*numbers) < GREATEST_NORM:
            written = ", ".join(f"{number:g}" for number in numbers)
            message = f"the orientation ({written}) of {state.vocabulary.short(individual)} is no rotation"
            yield Flaw(individual, ORIENTATION[0], "no-rotation", message, "for no turn write OrientationW 1.0")


def _sizes(state: WorldState) -> Iterator[Flaw]:
    short = state.vocabulary.short
    for name in POSITIVE:
        for individual, value in _stored(state, name):
            if isinstance(value, int | float) and value <= 0:
                message = f"{short(individual)}.{short(name)} = {value:g}: it must be greater than 0"
                yield Flaw(individual, name, "not-positive", message)


def _sheets(state: WorldState) -> Iterator[Flaw]:
    for arm in sorted(state.instances(ARM_DEVICE)):
        if HAS_SHEET in state.facts and not state.objects(arm, HAS_SHEET):
            short = state.vocabulary.short
            cure = f"say of which type it is: `{short(HAS_SHEET)} SHEET`"
            yield Flaw(arm, RDF_TYPE, "missing-sheet", f"the arm {short(arm)} has no data sheet", cure)


def _parents(state: WorldState) -> dict[str, str]:
    """Return in whose frame each thing is where the scene says so: by its base frame, else by the place it is at."""
    owners = _owners(state)
    places = sorted(state.pairs(AT), reverse=True) if AT in state.facts else []
    based = {individual: owners.get(str(base), []) for individual, base in _stored(state, BASE_FRAME_ID)}
    framed = {individual: found[0] for individual, found in based.items() if len(found) == 1}
    return {thing: place for thing, place in places if thing not in based} | framed


def _owners(state: WorldState) -> dict[str, list[str]]:
    owners: dict[str, list[str]] = {}
    for individual, frame in _stored(state, FRAME_ID):
        owners.setdefault(str(frame), []).append(individual)
    return owners


def _stored(state: WorldState, property_: str) -> list[tuple[str, object]]:
    """Return the individuals that have the property with their values, sorted by IRI."""
    table = state.stored.get(property_)
    found = [(individual, value) for individual, value in table.items() if value is not None] if table else []
    return sorted(found, key=lambda pair: pair[0])
