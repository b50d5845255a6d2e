"""Finds the types whose things make no difference to any plan unless a fact speaks of them.

Such a thing fits no parameter, so no action makes a fact about it true, and every quantifier that ranges over it is
sure of its answer for a thing of which nothing is true: `exists` of false, `forall` of true. Without it every formula
has the same value in every state that can be reached.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import assert_never

from skillc_model.pddl.domain import Meaning, PlanningDomain, Predicate, PropertyFact, RelationFact
from skillc_model.pddl.formulas import (
    FALSE,
    TRUE,
    Atom,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Universal,
    conjunction,
    disjunction,
)
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.world.state.world_state import WorldState


def find_relevant_types(domain: PlanningDomain, vocabulary: Vocabulary) -> frozenset[str]:
    """Return the types of which every thing counts; one of another type counts if a written fact speaks of it."""
    facts = frozenset(each.name for each in domain.predicates if _is_written(each, vocabulary))
    types = {each.type for action in domain.actions for each in action.parameters}
    for action in domain.actions:
        for formula in (action.precondition, action.hold, *(change.condition for change in action.effects)):
            types |= set(_told_apart(formula, facts))
    return frozenset(types)


def has_written_fact(individual: str, domain: PlanningDomain, state: WorldState) -> bool:
    """Whether a fact speaks of the individual that is written in the world model, as against computed."""
    return any(
        _speaks_of(each.meaning, individual, state) for each in domain.predicates if _is_written(each, state.vocabulary)
    )


def _is_written(predicate: Predicate, vocabulary: Vocabulary) -> bool:
    match predicate.meaning:
        case RelationFact():
            return True
        case PropertyFact(property=iri):
            return vocabulary.properties[iri].computed_by is None
        case _:
            return False


def _speaks_of(meaning: Meaning, individual: str, state: WorldState) -> bool:
    match meaning:
        case RelationFact(relation=relation):
            return bool(state.objects(individual, relation) or state.subjects(relation, individual))
        case PropertyFact(property=iri):
            return state.value(individual, iri) is not None
        case _:
            return False


def _told_apart(formula: Formula, facts: Set[str]) -> Iterator[str]:
    """Yield the types of quantified variables for which a thing without facts may decide the answer."""
    match formula:
        case Atom() | Equal() | Negation():
            pass
        case Conjunction(parts) | Disjunction(parts):
            for part in parts:
                yield from _told_apart(part, facts)
        case Existential(variable, body):
            if _without_facts(body, variable.name, facts) != FALSE:
                yield variable.type
            yield from _told_apart(body, facts)
        case Universal(variable, body):
            if _without_facts(body, variable.name, facts) != TRUE:
                yield variable.type
            yield from _told_apart(body, facts)
        case _:
            assert_never(formula)


def _without_facts(formula: Formula, variable: str, facts: Set[str]) -> Formula:
    """Return what is left of a formula when none of the facts speaks of the variable."""
    match formula:
        case Atom(predicate, terms):
            return FALSE if variable in terms and predicate in facts else formula
        case Negation(Atom(predicate, terms)):
            return TRUE if variable in terms and predicate in facts else formula
        case Equal() | Negation():
            return formula
        case Conjunction(parts):
            return conjunction(_without_facts(part, variable, facts) for part in parts)
        case Disjunction(parts):
            return disjunction(_without_facts(part, variable, facts) for part in parts)
        case Existential(inner, body):
            found = _without_facts(body, variable, facts)
            return FALSE if found == FALSE else Existential(inner, found)
        case Universal(inner, body):
            found = _without_facts(body, variable, facts)
            return TRUE if found == TRUE else Universal(inner, found)
        case _:
            assert_never(formula)
