"""Checks frames and poses: all frames lead to the map, and all poses are complete."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches

from skillc_runtime.scene.checks.stated_poses import check_stated_poses, supports_of
from skillc_runtime.scene.violation import SceneViolation, stored_values
from skillc_runtime.world.space.frame_tree import WORLD_FRAME
from skillc_runtime.world.state.terms import (
    AREA,
    ARM_DEVICE,
    AT,
    BASE_FRAME_ID,
    CONTAIN,
    FIXTURE,
    FRAME_ID,
    FURNITURE,
    HAS_A,
    MOBILE_ROBOT,
    ON,
    ORIENTATION,
    PERSON,
    POSITION,
    SCENE,
    SURFACE,
    TOOL,
)
from skillc_runtime.world.state.world_state import WorldState

PLACED = (AREA, ARM_DEVICE, FIXTURE, FURNITURE, MOBILE_ROBOT, PERSON, SURFACE, TOOL)
"""Classes whose individuals need a pose."""


def check_frames(state: WorldState) -> Iterator[SceneViolation]:
    """Yield problems of frames and poses; checks of terms that the vocabulary does not have find nothing."""
    owners = _owners(state)
    parents = _parents(state, owners)
    yield from _unknown_frames(state, owners)
    yield from _circles(state, parents)
    yield from _partial_poses(state)
    yield from _unplaced(state, parents)
    yield from check_stated_poses(state)


def _unknown_frames(state: WorldState, owners: Mapping[str, Sequence[str]]) -> Iterator[SceneViolation]:
    short = state.vocabulary.short
    for individual, base in stored_values(state, BASE_FRAME_ID):
        found = owners.get(str(base), [])
        if base == WORLD_FRAME or len(found) == 1:
            continue
        reason = f"{' and '.join(map(short, found))} have this FrameId" if found else "nothing has this FrameId"
        near = get_close_matches(str(base), [WORLD_FRAME, *owners], n=1)
        cure = f"did you mean `{near[0]}`?" if near else f"there is {', '.join(sorted([WORLD_FRAME, *owners]))}"
        message = f"{short(individual)} is placed in the frame `{base}`, but {reason}"
        cure = "give each its own" if found else cure
        yield SceneViolation(individual, BASE_FRAME_ID, "unknown-frame", message, cure)


def _circles(state: WorldState, parents: Mapping[str, str]) -> Iterator[SceneViolation]:
    reported = set[str]()
    placed = {individual: BASE_FRAME_ID for individual, _ in stored_values(state, BASE_FRAME_ID)}
    for individual, stated in sorted({**dict.fromkeys(supports_of(state), ON), **placed}.items()):
        path, at = [individual], parents.get(individual)
        while at is not None and at not in path:
            path.append(at)
            at = _carrier(state, parents, at)
        if at == individual and reported.isdisjoint(path):
            reported.update(path)
            names = " and ".join(map(state.vocabulary.short, path))
            message = f"the frames of {names} form a circle" if len(path) > 1 else f"{names} is placed in its own frame"
            cure = f"place one of them in `{WORLD_FRAME}`"
            yield SceneViolation(individual, stated, "frame-circle", message, cure)


def _carrier(state: WorldState, parents: Mapping[str, str], thing: str) -> str | None:
    """Return the carrier of an object: the owner of its frame, its place, or else what contains or has it."""
    if thing in parents or state.value(thing, BASE_FRAME_ID) is not None:
        return parents.get(thing)
    holders = (state.subjects(relation, thing) for relation in (CONTAIN, HAS_A) if relation in state.facts)
    return next((min(found) for found in holders if found), None)


def _partial_poses(state: WorldState) -> Iterator[SceneViolation]:
    """Yield poses in a frame that lack some of their numbers."""
    short = state.vocabulary.short
    for individual, _ in stored_values(state, BASE_FRAME_ID):
        turn = _find_missing(state, individual, ORIENTATION)
        lost = _find_missing(state, individual, POSITION) + (turn if len(turn) < len(ORIENTATION) else [])
        if lost:
            message = f"{short(individual)} has a {short(BASE_FRAME_ID)} and no {', '.join(map(short, lost))}"
            cure = "write all of its position, and of its quaternion if it has one"
            yield SceneViolation(individual, BASE_FRAME_ID, "partial-pose", message, cure)


def _find_missing(state: WorldState, individual: str, names: Sequence[str]) -> list[str]:
    return [name for name in names if name in state.stored and state.value(individual, name) is None]


def _unplaced(state: WorldState, parents: Mapping[str, str]) -> Iterator[SceneViolation]:
    """Yield objects that need a pose but have neither a base frame nor a place."""
    if BASE_FRAME_ID not in state.stored or AT not in state.facts:
        return
    short = state.vocabulary.short
    based = {individual for individual, _ in stored_values(state, BASE_FRAME_ID)} | supports_of(state).keys()
    needed = {thing for cls in PLACED for thing in state.instances(cls)}
    needed |= {
        parent for thing in needed if (parent := parents.get(thing)) is not None and not _is_floor(state, parent)
    }
    for thing in sorted(needed - based - parents.keys()):
        message = f"the scene does not say where {short(thing)} is"
        cure = f'place it in a frame, `{short(BASE_FRAME_ID)} "{WORLD_FRAME}"`, or at a place, `{short(AT)} PLACE`'
        cure += f", or on a thing, `{short(ON)} THING`" if ON in state.facts else ""
        yield SceneViolation(thing, None, "no-place", message, cure)


def _is_floor(state: WorldState, thing: str) -> bool:
    """Whether a thing is the whole scene, which needs no pose: what is on it stands on the floor of the world."""
    return state.is_a(thing, SCENE)


def _parents(state: WorldState, owners: Mapping[str, Sequence[str]]) -> dict[str, str]:
    """Return the object in whose frame each object is: by its base frame, else what it is on, else the place."""
    places = sorted(state.pairs(AT), reverse=True) if AT in state.facts else []
    based = {individual: owners.get(str(base), []) for individual, base in stored_values(state, BASE_FRAME_ID)}
    framed = {individual: found[0] for individual, found in based.items() if len(found) == 1}
    resting = {thing: support for thing, support in supports_of(state).items() if thing not in based}
    return {thing: place for thing, place in places if thing not in based} | resting | framed


def _owners(state: WorldState) -> dict[str, list[str]]:
    owners: dict[str, list[str]] = {}
    for individual, frame in stored_values(state, FRAME_ID):
        owners.setdefault(str(frame), []).append(individual)
    for _, base in stored_values(state, BASE_FRAME_ID):
        if state.types(str(base)) and state.value(str(base), FRAME_ID) is None:
            owners.setdefault(str(base), [str(base)])
    return owners
