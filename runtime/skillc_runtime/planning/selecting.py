"""Chooses the objects of a problem and says why the other individuals of the scene are left out."""

from __future__ import annotations

from collections.abc import Iterator, Set
from dataclasses import dataclass

from skillc_compiler.library.pddl.domain import PlanningDomain
from skillc_compiler.library.vocabulary import Vocabulary
from skillc_runtime.planning.inert import is_spoken_of, told_types
from skillc_runtime.planning.left_out import LeftOut
from skillc_runtime.planning.narrowing import Breadth, near
from skillc_runtime.planning.variables import variables
from skillc_runtime.world.state import WorldState

NO_USE = "no useful action, no condition of one and no goal can speak of them"
NO_FACT = "they fit no parameter, and no fact that a condition reads speaks of them"
FAR = "they are far from what the goal speaks of"


@dataclass(frozen=True, slots=True)
class Selection:
    """The types of the individuals that are kept, and of the `others` that may make a difference but are not."""

    kept: dict[str, str]
    others: dict[str, str]
    left_out: tuple[LeftOut, ...]


def select(domain: PlanningDomain, state: WorldState, named: Set[str], breadth: Breadth | None) -> Selection:
    """Return the individuals to plan with; those of `named` are kept, and with a breadth what is near them."""
    types = dict(_types(domain, state))
    told, ranged = told_types(domain, state.vocabulary), {each.type for each in variables(domain)}
    counts = {each: _fits(domain, each, told) for each in set(types.values())}
    may_count = {each: _fits(domain, each, ranged) for each in counts}
    candidates = {iri: each for iri, each in types.items() if may_count[each] or iri in named}
    silent = {
        iri
        for iri, each in candidates.items()
        if not counts[each] and iri not in named and not is_spoken_of(iri, domain, state)
    }
    kept = {iri: each for iri, each in candidates.items() if iri not in silent} if silent else candidates
    found = frozenset(kept)
    if breadth is not None and len(kept) > breadth.objects:
        found = near(domain, state, kept, named, breadth)
    others = {iri: each for iri, each in kept.items() if iri not in found}
    reasons = (
        LeftOut(tuple(sorted(types.keys() - candidates.keys())), NO_USE, harmless=True),
        LeftOut(tuple(sorted(silent)), NO_FACT, harmless=True),
        LeftOut(tuple(sorted(others)), FAR, harmless=False),
    )
    chosen = {iri: each for iri, each in kept.items() if iri in found} if others else kept
    return Selection(chosen, others, tuple(each for each in reasons if each.what))


def lowest_of(classes: frozenset[str], vocabulary: Vocabulary) -> frozenset[str]:
    """Return the classes that are above none of the others."""
    if len(classes) == 1:
        return classes
    return frozenset(
        cls for cls in classes if not any(other != cls and vocabulary.is_a(other, cls) for other in classes)
    )


def _types(domain: PlanningDomain, state: WorldState) -> Iterator[tuple[str, str]]:
    """Yield the individuals with their most specific types."""
    known: dict[frozenset[str], str] = {}
    for iri, classes in state.direct.items():
        if classes not in known:
            known[classes] = domain.type_of(lowest_of(classes, state.vocabulary))
        yield iri, known[classes]


def _fits(domain: PlanningDomain, type_: str, wanted: Set[str]) -> bool:
    return any(domain.is_a(type_, each) for each in wanted)
