"""Grounds a goal: quantifiers are expanded, and conditions that no skill changes are evaluated in the initial world."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias, assert_never

from skillc_model.conditions import (
    And,
    Anything,
    Compare,
    Condition,
    Exists,
    Forall,
    Given,
    HasProperty,
    Holds,
    Individual,
    IsA,
    Not,
    Or,
    Same,
)
from skillc_model.pddl.domain import PlanningDomain, PropertyMeaning, RelationMeaning
from skillc_model.pddl.formulas import FALSE, TRUE, Formula, Typed, atoms
from skillc_model.pddl.hierarchy import Hierarchy
from skillc_model.pddl.symbols import Symbols
from skillc_model.pddl.translate import NamedIndividual, Scope, Translator
from skillc_model.rewriting import map_children, substitute
from skillc_model.skills import SkillLibrary

Members: TypeAlias = Callable[[str], Sequence[str]]


def ground_goal(
    goal: Condition,
    library: SkillLibrary,
    domain: PlanningDomain,
    objects: Mapping[str, Typed],
    members: Members,
    holds: Callable[[Condition], bool],
) -> Formula:
    """Return the goal over the objects of a problem; TRUE or FALSE if no skill can change its value.

    `objects` are names with types by IRI, `members` returns the individuals of a class, `holds` whether a condition
    holds in the initial world. Untranslatable (as in "the goal reads ..") names what a planner cannot reason about.
    """
    symbols = _symbols(library, domain)

    def evaluate(condition: Condition, scope: Scope) -> Formula:
        return TRUE if holds(condition) else FALSE

    named = {iri: NamedIndividual(each, frozenset()) for iri, each in objects.items()}
    return Translator(symbols, evaluate, named).formula(_ground(goal, symbols, members), {})


def add_goal_predicates(goal: Formula, library: SkillLibrary, domain: PlanningDomain) -> PlanningDomain:
    """Return the domain with the predicates that only the goal uses, so that the problem initialises them."""
    missing = {atom.predicate for atom in atoms(goal)} - domain.predicate.keys()
    if not missing:
        return domain
    symbols = _symbols(library, domain)
    extended = (*domain.predicates, *(symbols.predicate(name) for name in missing))
    return replace(domain, predicates=tuple(sorted(extended, key=lambda each: each.name)))


def _symbols(library: SkillLibrary, domain: PlanningDomain) -> Symbols:
    vocabulary = library.vocabulary
    changing: set[str] = set()
    for predicate in domain.predicates:
        if predicate.changes:
            match predicate.meaning:
                case RelationMeaning(relation=iri) | PropertyMeaning(property=iri):
                    changing.add(iri)
    hierarchy = Hierarchy(vocabulary, {name: term for term, name in domain.names.items()}, domain.combined)
    return Symbols(vocabulary, domain.names, hierarchy, frozenset(changing), settled=True)


def _ground(condition: Condition, symbols: Symbols, members: Members) -> Condition:
    match condition:
        case Not() | And() | Or():
            return map_children(condition, lambda part: _ground(part, symbols, members))
        case Exists():
            return Or(_cases(condition, symbols, members))
        case Forall():
            return And(_cases(condition, symbols, members))
        case Holds(subject=Anything(), relation=relation, object=object_):
            some = members(symbols.side_class(relation, 0))
            found = (Holds(Individual(iri), relation, object_) for iri in some)
            return Or(tuple(_ground(each, symbols, members) for each in found))
        case Holds(subject=subject, relation=relation, object=Anything()):
            return Or(
                tuple(Holds(subject, relation, Individual(iri)) for iri in members(symbols.side_class(relation, 1)))
            )
        case Holds() | Compare() | Same() | HasProperty() | IsA() | Given():
            return condition
        case _:
            assert_never(condition)


def _cases(quantified: Exists | Forall, symbols: Symbols, members: Members) -> tuple[Condition, ...]:
    bodies = (substitute(quantified.body, {quantified.variable: Individual(iri)}) for iri in members(quantified.cls))
    return tuple(_ground(body, symbols, members) for body in bodies)
