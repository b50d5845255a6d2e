"""Lists what facts about an individual can say, for people who state them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator

from skillc.contract.world import StatableFacts, StatableTerm
from skillc_model.format_type import format_type
from skillc_rdf.vocabulary.types import PropertyTerm, RelationTerm, Vocabulary, local_name
from skillc_runtime.world.state.elements import unit_of
from skillc_runtime.world.state.names import resolve_individual
from skillc_runtime.world.state.world_state import WorldState

MOST_THINGS = 1000
"""How many individuals of a class are named."""


def list_terms(subject: str, state: WorldState, shipped: Collection[str]) -> StatableFacts:
    """Return what may be stated of an individual that `subject` names; NoSuchName if there is none.

    What is computed cannot be stated. Individuals that are `shipped` are not named.
    """
    individual, known = resolve_individual(subject, state), state.vocabulary
    name = _namer(known)
    terms = (*_relations(individual, state, name), *_properties(individual, state, name))
    classes = {known.expand(cls) if ":" in cls else cls for term in terms for cls in term.objects}
    things = {known.short(cls): _instances(cls, state, shipped) for cls in sorted(classes)}
    return StatableFacts(tuple(sorted(terms, key=lambda each: (each.name.lower(), each.iri))), things)


def _instances(cls: str, state: WorldState, shipped: Collection[str]) -> tuple[str, ...]:
    found = sorted(state.instances(cls).difference(shipped))
    return tuple(state.vocabulary.short(each) for each in found[:MOST_THINGS])


def _namer(known: Vocabulary) -> Callable[[str], str]:
    """Return what gives a term the name that a fact has: its last part, with a prefix if others end in the same."""
    kinds = (known.relations, known.properties)
    shared = {name for kind in kinds for name, count in Counter(map(local_name, kind)).items() if count > 1}
    return lambda iri: known.short(iri) if local_name(iri) in shared else local_name(iri)


def _relations(individual: str, state: WorldState, name: Callable[[str], str]) -> Iterator[StatableTerm]:
    known = state.vocabulary
    for iri, term in known.relations.items():
        ranges = {each.range for each in term.signatures if state.is_a(individual, each.domain)}
        if ranges and not _is_hidden(term, known):
            objects = tuple(sorted(map(known.short, ranges)))
            yield StatableTerm(
                iri, name(iri), "relation", " or ".join(objects), "", (), objects, term.functional, term.comment
            )


def _properties(individual: str, state: WorldState, name: Callable[[str], str]) -> Iterator[StatableTerm]:
    known = state.vocabulary
    for iri, term in known.properties.items():
        if any(state.is_a(individual, each) for each in term.domains) and not _is_hidden(term, known):
            type_ = format_type(term.type, known)
            yield StatableTerm(
                iri, name(iri), "property", type_, unit_of(iri, known), term.values, (), term.functional, term.comment
            )


def _is_hidden(term: RelationTerm | PropertyTerm, known: Vocabulary) -> bool:
    """Whether a fact about a term cannot, or should not, be stated."""
    return term.computed_by is not None or term.iri in known.deprecated
