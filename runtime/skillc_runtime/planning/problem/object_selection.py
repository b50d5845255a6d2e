"""Chooses the objects of a problem and says why the other individuals of the scene are left out."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass
from itertools import chain
from typing import TypeAlias

from skillc_model.pddl.constants import lowest
from skillc_model.pddl.domain import PlanningDomain
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.planning.plan import LeftOut
from skillc_runtime.planning.problem.irrelevant_types import find_relevant_types, has_written_fact
from skillc_runtime.planning.problem.neighbourhood import AbstractionSize, select_near
from skillc_runtime.planning.typed_variables import list_typed_variables
from skillc_runtime.world.state.world_state import WorldState

NO_USE = "no useful action, no condition of one and no goal can speak of them"
NO_FACT = "they fit no parameter, and no fact that a condition reads speaks of them"
FAR = "they are far from what the goal speaks of"

Kinds: TypeAlias = Mapping[frozenset[str], Sequence[str]]
"""The individuals of a scene by the classes that they were declared to be of."""


@dataclass(frozen=True, slots=True)
class ObjectSelection:
    """The types of the individuals that are kept, and by type the `others` that may make a difference but are not."""

    kept: dict[str, str]
    others: dict[str, tuple[str, ...]]
    left_out: tuple[LeftOut, ...]


def group_by_class(state: WorldState) -> Kinds:
    """Return the individuals by their classes: of these there are few, however large the scene is."""
    kinds: dict[frozenset[str], list[str]] = defaultdict(list)
    for iri, classes in state.direct.items():
        kinds[classes].append(iri)
    return kinds


def select_objects(
    domain: PlanningDomain, state: WorldState, kinds: Kinds, named: Set[str], breadth: AbstractionSize | None
) -> ObjectSelection:
    """Return the individuals to plan with; those of `named` are kept, and with a breadth what is near them."""
    candidates, useless, silent = _candidates(domain, state, kinds, named)
    others: dict[str, tuple[str, ...]] = {}
    if breadth is not None and sum(map(len, candidates.values())) > breadth.objects:
        found = select_near(domain, state, candidates, named, breadth)
        far = {each: tuple(iri for iri in iris if iri not in found) for each, iris in candidates.items()}
        others = {each: iris for each, iris in far.items() if iris}
        candidates = {each: [iri for iri in iris if iri in found] for each, iris in candidates.items()}
    reasons = (
        LeftOut(useless, NO_USE, harmless=True),
        LeftOut(silent, NO_FACT, harmless=True),
        LeftOut(tuple(chain.from_iterable(others.values())), FAR, harmless=False),
    )
    kept = {iri: each for each, iris in candidates.items() for iri in iris}
    return ObjectSelection(kept, others, tuple(each for each in reasons if each.members))


def _candidates(
    domain: PlanningDomain, state: WorldState, kinds: Kinds, named: Set[str]
) -> tuple[dict[str, list[str]], list[str], list[str]]:
    """Return by type who may make a difference; those whom nothing can speak of; those of whom nothing is said."""
    candidates: dict[str, list[str]] = {}
    useless: list[str] = []
    silent: list[str] = []
    told, ranged = find_relevant_types(domain, state.vocabulary), {each.type for each in list_typed_variables(domain)}
    for type_, iris in _by_type(domain, kinds, state.vocabulary).items():
        if _fits(domain, type_, told):
            candidates[type_] = iris
            continue
        may_count = _fits(domain, type_, ranged)
        rest = silent if may_count else useless
        spoken_of = {iri for iri in iris if iri in named or (may_count and has_written_fact(iri, domain, state))}
        candidates[type_] = list(spoken_of)
        rest.extend(iri for iri in iris if iri not in spoken_of)
    return candidates, useless, silent


def _by_type(domain: PlanningDomain, kinds: Kinds, vocabulary: Vocabulary) -> dict[str, list[str]]:
    """Return the individuals by their most specific types."""
    found: dict[str, list[str]] = {}
    for classes, iris in kinds.items():
        found.setdefault(domain.type_of(lowest(classes, vocabulary)), []).extend(iris)
    return found


def _fits(domain: PlanningDomain, type_: str, wanted: Set[str]) -> bool:
    return any(domain.is_a(type_, each) for each in wanted)
