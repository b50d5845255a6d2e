"""Finds the types whose objects do not affect any plan unless there is an asserted fact about them.

An object of such a type fits no parameter, so no action makes a fact about it true; and for an object without facts,
the body of every quantifier that ranges over it is constant: false below `exists`, true below `forall`. So leaving it
out changes the value of no formula in any reachable state.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias, assert_never

from skillc_model.pddl.domain import Meaning, PlanningDomain, Predicate, PropertyMeaning, RelationMeaning
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

MayHold: TypeAlias = Callable[[Atom], bool]
"""Whether an atom about a variable may be true for the values that are considered."""


def find_relevant_types(domain: PlanningDomain, vocabulary: Vocabulary) -> frozenset[str]:
    """Return the types whose objects are all relevant; other objects are if they have an asserted fact."""
    facts = frozenset(each.name for each in domain.predicates if _is_asserted(each, vocabulary))
    types = {each.type for action in domain.actions for each in action.parameters}
    for action in domain.actions:
        for formula in (action.precondition, action.hold, *(change.condition for change in action.effects)):
            types |= set(_list_deciding_types(formula, lambda atom: atom.predicate not in facts))
    return frozenset(types)


def has_asserted_fact(individual: str, domain: PlanningDomain, state: WorldState) -> bool:
    """Whether the world model has a fact about the individual that is asserted, not computed."""
    return any(
        _mentions(each.meaning, individual, state) for each in domain.predicates if _is_asserted(each, state.vocabulary)
    )


def _is_asserted(predicate: Predicate, vocabulary: Vocabulary) -> bool:
    match predicate.meaning:
        case RelationMeaning():
            return True
        case PropertyMeaning(property=iri):
            return vocabulary.properties[iri].computed_by is None
        case _:
            return False


def _mentions(meaning: Meaning, individual: str, state: WorldState) -> bool:
    match meaning:
        case RelationMeaning(relation=relation):
            return bool(state.objects(individual, relation) or state.subjects(relation, individual))
        case PropertyMeaning(property=iri):
            return state.value(individual, iri) is not None
        case _:
            return False


def _list_deciding_types(formula: Formula, may_hold: MayHold) -> Iterator[str]:
    """Yield the types of quantified variables for which an object without facts may decide the value."""
    match formula:
        case Atom() | Equal() | Negation():
            pass
        case Conjunction(parts) | Disjunction(parts):
            for part in parts:
                yield from _list_deciding_types(part, may_hold)
        case Existential(variable, body):
            if simplify_for(body, variable.name, may_hold) != FALSE:
                yield variable.type
            yield from _list_deciding_types(body, may_hold)
        case Universal(variable, body):
            if simplify_for(body, variable.name, may_hold) != TRUE:
                yield variable.type
            yield from _list_deciding_types(body, may_hold)
        case _:
            assert_never(formula)


def simplify_for(formula: Formula, variable: str, may_hold: MayHold) -> Formula:
    """Return the formula simplified for values of a variable about which only atoms that `may_hold` can be true."""
    match formula:
        case Atom(terms=terms):
            return FALSE if variable in terms and not may_hold(formula) else formula
        case Negation(Atom(terms=terms) as atom):
            return TRUE if variable in terms and not may_hold(atom) else formula
        case Equal() | Negation():
            return formula
        case Conjunction(parts):
            return conjunction(simplify_for(part, variable, may_hold) for part in parts)
        case Disjunction(parts):
            return disjunction(simplify_for(part, variable, may_hold) for part in parts)
        case Existential(inner, body):
            found = simplify_for(body, variable, may_hold)
            return FALSE if found == FALSE else Existential(inner, found)
        case Universal(inner, body):
            found = simplify_for(body, variable, may_hold)
            return TRUE if found == TRUE else Universal(inner, found)
        case _:
            assert_never(formula)
