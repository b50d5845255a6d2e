"""Checks that individuals state what their classes require."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.state.data_sheet import DataSheet
from skillc_runtime.world.state.quantities import placeholder
from skillc_runtime.world.state.terms import ARM_SHEET, SKILLC
from skillc_runtime.world.state.world_state import WorldState

LISTED = 3
"""The most individuals and terms that are named where nothing reads what is missing."""


def check_required(state: WorldState) -> Iterator[SceneViolation]:
    """Yield each individual that lacks required properties or relations, once with all of them.

    What is lacking of terms that no skill reads is one warning.
    """
    idle = frozenset(state.vocabulary.idle)
    unread: dict[str, list[str]] = {}
    for individual, required in _required(state):
        lost = {predicate: cls for predicate, cls in required if not _has(state, individual, predicate)}
        if lost and state.is_a(individual, ARM_SHEET):
            open_ = {f"{SKILLC}{name}" for name in DataSheet(state, individual).unstated}
            lost = {predicate: cls for predicate, cls in lost.items() if predicate not in open_}
        if left := sorted(lost.keys() & idle):
            unread[individual] = left
        if lost.keys() - idle:
            yield _lacking(state, individual, {each: cls for each, cls in lost.items() if each not in idle})
    if unread:
        yield _unread(state, unread)


def _lacking(state: WorldState, individual: str, lost: Mapping[str, str]) -> SceneViolation:
    """Return the violation of an individual that lacks terms, each with the class that requires it."""
    short = state.vocabulary.short
    of = ", ".join(sorted({short(cls) for cls in lost.values()}))
    names = ", ".join(map(short, sorted(lost)))
    message = f"{short(individual)} has no {names}, as every {of} must"
    cure = " ".join(f"`{short(name)} {_placeholder(state, name)} ;`" for name in sorted(lost))
    return SceneViolation(individual, None, "missing-property", message, f"write {cure}")


def _unread(state: WorldState, found: Mapping[str, list[str]]) -> SceneViolation:
    """Return the warning for individuals that lack terms which no skill reads."""
    who = _listed(map(state.vocabulary.short, found))
    what = _listed(map(state.vocabulary.short, sorted({each for lost in found.values() for each in lost})))
    message = f"{who} lack{'s' * (len(found) == 1)} what their classes require: {what}"
    cure = "state it before a skill reads it: it is an error then"
    return SceneViolation(next(iter(found)), None, "missing-property", message, cure, "warning")


def _listed(names: Iterable[str]) -> str:
    first = [*names]
    return ", ".join(first[:LISTED]) + (f" and {len(first) - LISTED} more" if first[LISTED:] else "")


def _required(state: WorldState) -> list[tuple[str, tuple[tuple[str, str], ...]]]:
    """Return the individuals with requirements, sorted by IRI, each with predicates and the classes requiring them."""
    known = state.vocabulary.classes
    by_classes: dict[frozenset[str], tuple[tuple[str, str], ...]] = {}
    for classes in {classes for _, classes in state.classes.items()}:
        above = (known[cls] for cls in sorted(classes) if cls in known)
        by_classes[classes] = tuple((predicate, term.iri) for term in above for predicate in term.required)
    ours = ((one, classes) for one, classes in state.classes.items() if one not in state.vocabulary.individuals)
    return sorted((one, by_classes[classes]) for one, classes in ours if by_classes[classes])


def _has(state: WorldState, individual: str, predicate: str) -> bool:
    if predicate in state.facts:
        return bool(state.objects(individual, predicate))
    if predicate in state.vocabulary.properties:
        computed = state.vocabulary.properties[predicate].computed_by is not None
        return computed or state.value(individual, predicate) is not None
    return True


def _placeholder(state: WorldState, predicate: str) -> str:
    """Return a placeholder for the object of a predicate."""
    term = state.vocabulary.properties.get(predicate)
    if term is None:
        ranges = state.vocabulary.relations[predicate].signatures
        return state.vocabulary.short(ranges[0].range).partition(":")[2].upper() if ranges else "THING"
    return placeholder(term)
