"""Selects the objects of a problem, with the reasons why the other individuals of the scene are left out."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence, Set
from functools import cache
from itertools import chain
from typing import TypeAlias

import msgspec

from skillc_model.pddl.constants import most_specific
from skillc_model.pddl.domain import PlanningDomain
from skillc_model.pddl.formulas import Formula
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.planning.plan import LeftOut
from skillc_runtime.planning.problem.backward import find_needed_individuals
from skillc_runtime.planning.problem.constant_bodies import ConstantBodies
from skillc_runtime.planning.problem.irrelevant_types import find_relevant_types, has_asserted_fact
from skillc_runtime.planning.problem.neighbourhood import AbstractionSize, select_near
from skillc_runtime.planning.problem.static_bindings import TypedIndividuals
from skillc_runtime.planning.typed_variables import list_typed_variables
from skillc_runtime.world.state.world_state import WorldState

IRRELEVANT = "neither the goal nor a useful action can refer to them"
WITHOUT_FACTS = "they fit no parameter, and no condition reads a fact about them"
UNNEEDED = "no step that helps to reach the goal involves them"
FAR = "they are far from what the goal refers to"

IndividualsByClass: TypeAlias = Mapping[frozenset[str], Sequence[str]]
"""The individuals of a scene by their declared classes."""


class ObjectSelection(msgspec.Struct, frozen=True):
    """The types of the individuals that are kept, and by type the `others`, which are not but may be relevant."""

    kept: dict[str, str]
    others: dict[str, tuple[str, ...]]
    left_out: tuple[LeftOut, ...]


def group_by_class(state: WorldState) -> IndividualsByClass:
    """Return the individuals by their declared classes; even large scenes have few combinations of these."""
    kinds: dict[frozenset[str], list[str]] = defaultdict(list)
    for iri, classes in state.direct.items():
        kinds[classes].append(iri)
    return kinds


def select_objects(
    domain: PlanningDomain,
    state: WorldState,
    kinds: IndividualsByClass,
    named: Set[str],
    size: AbstractionSize | None,
    goal: Formula | None = None,
) -> ObjectSelection:
    """Return the objects of the problem, among them all of `named`; with a `size`, only those near these.

    Those that no helpful step involves are left out if the `goal` is given, which names individuals by their IRIs.
    """
    candidates, useless, without_facts = _candidates(domain, state, kinds, named)
    candidates, unneeded = (
        (candidates, []) if goal is None else _leave_out_unneeded(domain, state, candidates, named, goal)
    )
    others: dict[str, tuple[str, ...]] = {}
    if size is not None and sum(map(len, candidates.values())) > size.most_kept:
        found = select_near(domain, state, candidates, named, size)
        far = {each: tuple(iri for iri in iris if iri not in found) for each, iris in candidates.items()}
        others = {each: iris for each, iris in far.items() if iris}
        candidates = {each: [iri for iri in iris if iri in found] for each, iris in candidates.items()}
    reasons = (
        LeftOut(useless, IRRELEVANT, harmless=True),
        LeftOut(without_facts, WITHOUT_FACTS, harmless=True),
        LeftOut(unneeded, UNNEEDED, harmless=True),
        LeftOut(tuple(chain.from_iterable(others.values())), FAR, harmless=False),
    )
    kept = {iri: each for each, iris in candidates.items() for iri in iris}
    return ObjectSelection(kept, others, tuple(each for each in reasons if each.members))


def _candidates(
    domain: PlanningDomain, state: WorldState, kinds: IndividualsByClass, named: Set[str]
) -> tuple[dict[str, list[str]], list[str], list[str]]:
    """Return the relevant individuals by type, those that nothing can refer to, and those without facts."""
    candidates: dict[str, list[str]] = {}
    useless: list[str] = []
    without_facts: list[str] = []
    relevant, quantified = (
        find_relevant_types(domain, state.vocabulary),
        {each.type for each in list_typed_variables(domain)},
    )
    for type_, iris in _group_by_type(domain, kinds, state.vocabulary).items():
        if _fits(domain, type_, relevant):
            candidates[type_] = iris
            continue
        is_quantified = _fits(domain, type_, quantified)
        rest = without_facts if is_quantified else useless
        mentioned = {iri for iri in iris if iri in named or (is_quantified and has_asserted_fact(iri, domain, state))}
        candidates[type_] = list(mentioned)
        rest.extend(iri for iri in iris if iri not in mentioned)
    return candidates, useless, without_facts


def _leave_out_unneeded(
    domain: PlanningDomain, state: WorldState, candidates: dict[str, list[str]], named: Set[str], goal: Formula
) -> tuple[dict[str, list[str]], list[str]]:
    """Return the candidates without those that no plan needs, and these; all if it would take long to find out."""

    @cache
    def type_of_kind(classes: frozenset[str]) -> str:
        return domain.type_of(most_specific(classes, state.vocabulary))

    def type_of(individual: str) -> str:
        return type_of_kind(state.types(individual))

    needed = find_needed_individuals(domain, state, goal, TypedIndividuals(domain, candidates, type_of))
    if needed is None:
        return candidates, []
    constant = ConstantBodies(domain, state, type_of)
    kept: dict[str, list[str]] = {}
    unneeded: list[str] = []
    for type_, iris in candidates.items():
        kept[type_] = []
        for iri in iris:
            free = iri not in needed and iri not in named and constant.are_for(iri)
            (unneeded if free else kept[type_]).append(iri)
    return kept, unneeded


def _group_by_type(domain: PlanningDomain, kinds: IndividualsByClass, vocabulary: Vocabulary) -> dict[str, list[str]]:
    """Return the individuals by their most specific types."""
    found: dict[str, list[str]] = {}
    for classes, iris in kinds.items():
        found.setdefault(domain.type_of(most_specific(classes, vocabulary)), []).extend(iris)
    return found


def _fits(domain: PlanningDomain, type_: str, wanted: Set[str]) -> bool:
    return any(domain.is_a(type_, each) for each in wanted)
