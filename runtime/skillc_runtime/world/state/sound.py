"""Whether a whole world obeys the axioms: each rule once for all facts that look alike, instead of fact by fact."""

from __future__ import annotations

from itertools import combinations
from math import isfinite

from skillc_compiler.library.vocabulary import NumberType, PlainType, PropertyTerm, RelationTerm
from skillc_runtime.world.state.axiom_violations import wrong_value
from skillc_runtime.world.state.links import Links
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


def is_sound(state: WorldState) -> bool:
    """Whether no fact breaks an axiom; what `broken` finds fault with is never sound.

    A world in which facts of a functional relation compete is not.
    """
    return (
        _classes_agree(state)
        and all(_fits(state, iri, links) for iri, links in state.asserted.items())
        and all(_obeys(term, state.facts[iri]) for iri, term in state.vocabulary.relations.items())
        and all(_has_values(state, iri) for iri in state.stored)
    )


def _classes_agree(state: WorldState) -> bool:
    """Whether there are all classes, and none of those of an individual are disjoint."""
    vocabulary = state.vocabulary
    for types in {types for _, types in state.direct.items()}:
        pairs = combinations(sorted(types), 2)
        if not types <= vocabulary.ancestors.keys() or any(vocabulary.disjoint(*pair) for pair in pairs):
            return False
    return True


def _fits(state: WorldState, relation: str, links: Links) -> bool:
    """Whether all that is written of a relation is between individuals of the classes that it takes."""
    if relation in state.axioms.computed:
        return not links.forward
    of = state.classes.get
    terms = [(state.vocabulary.relations[iri], flipped) for iri, flipped in state.axioms.implied[relation]]
    if any(term.irreflexive or term.asymmetric for term, _ in terms) and any(
        start == end for start, end in links.pairs()
    ):
        return False
    for start, end in {(of(start), of(end)) for start, end in links.pairs()}:
        if not start or not end:
            return False
        if not all(_takes(term, end, start) if flipped else _takes(term, start, end) for term, flipped in terms):
            return False
    return True


def _takes(term: RelationTerm, subject: frozenset[str], object_: frozenset[str]) -> bool:
    return not term.signatures or any(each.domain in subject and each.range in object_ for each in term.signatures)


def _obeys(term: RelationTerm, facts: Links) -> bool:
    """Whether the facts of a relation are as few as it says, and none is the opposite of another."""
    if term.functional and any(len(objects) > 1 for _, objects in facts.forward.items()):
        return False
    if term.inverse_functional and any(len(subjects) > 1 for _, subjects in facts.backward.items()):
        return False
    opposite = facts.backward.get
    return not term.asymmetric or all(start == end or end not in opposite(start) for start, end in facts.pairs())


def _has_values(state: WorldState, property_: str) -> bool:
    """Whether all values of a property are of its type, and belong to individuals that may have it."""
    table, term = state.stored[property_], state.vocabulary.properties[property_]
    if not table:
        return True
    owners = {state.classes.get(individual) for individual, _ in table.items()}
    if term.computed_by is not None or not all(owners):
        return False
    if term.domains and any(owner.isdisjoint(term.domains) for owner in owners):
        return False
    return _are_values([value for _, value in table.items()], term)


def _are_values(found: list[Value | None], term: PropertyTerm) -> bool:
    """Whether all are values of a property; numbers and texts are looked at together."""
    kinds = set(map(type, found))
    if kinds == {float} and isinstance(term.type, NumberType):
        bounds = term.bounds
        return all(isinstance(v, float) and isfinite(v) and (bounds is None or bounds.hold(v)) for v in found)
    if kinds == {str} and term.type == PlainType("Text"):
        return not term.values or {value for value in found if isinstance(value, str)} <= {*term.values}
    each = (one for value in found for one in (value if isinstance(value, tuple) and not term.functional else (value,)))
    return not any(one is None or wrong_value(term, one) for one in each)
