"""Builds the world from the triples of a store."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

import msgspec
import pyoxigraph as ox

from skillc_rdf.vocabulary.types import ClassTerm, Vocabulary
from skillc_runtime.store.literals import LiteralError, read_literal
from skillc_runtime.store.triples import CLASS, PREFIX, SUBCLASS, TYPE
from skillc_runtime.world.state.bulk import FactTables, build_world_state
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.consistency.axiom_violations import axiom_violations
from skillc_runtime.world.state.consistency.representatives import satisfies_axioms
from skillc_runtime.world.state.transactions import StoreError
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

MAX_REPORTED = 5
"""The maximum number of problems in a message."""


class _Contents(msgspec.Struct, frozen=True):
    """Triples by kind: types, relations and properties of individuals, classes with their parents, prefixes."""

    types: dict[str, list[str]]
    related: list[tuple[str, str, str]]
    valued: dict[tuple[str, str], list[ox.Literal]]
    classes: dict[str, list[str]]
    prefixes: dict[str, str]


def build_world(triples: Iterable[ox.Triple], library: Vocabulary, store: str) -> WorldState:
    """Return the world of triples; StoreError, which names the store, when they do not fit the library's vocabulary."""
    contents = _sort_triples(triples)
    own = {iri: ClassTerm(iri=iri, parents=tuple(sorted(parents))) for iri, parents in contents.classes.items()}
    prefixes, classes = {**contents.prefixes, **library.prefixes}, {**own, **library.classes}
    vocabulary = msgspec.structs.replace(library, prefixes=prefixes, classes=classes)
    state = _build_in_bulk(contents, vocabulary)
    if state is not None:
        return state
    problems: list[str] = []
    changes = tuple(_changes(contents, vocabulary, problems))
    state = WorldState.empty(vocabulary).with_changes(changes)
    problems += [violation.message for change in changes for violation in axiom_violations(state, change)]
    if problems:
        distinct = list(dict.fromkeys(problems))
        more = f"; and {len(distinct) - MAX_REPORTED} more" if len(distinct) > MAX_REPORTED else ""
        raise StoreError(
            f"{store} does not go with these skills: {'; '.join(distinct[:MAX_REPORTED])}{more}. "
            "Use the library it was filled with, or fill it again with --reset"
        )
    return state


def _build_in_bulk(contents: _Contents, vocabulary: Vocabulary) -> WorldState | None:
    """Return the world of all facts at once; None if something does not fit, which changes one by one say what.

    It is that of the changes, in a quarter of their time.
    """
    types, classes = contents.types, vocabulary.ancestors.keys()
    related: dict[str, list[tuple[str, str]]] = defaultdict(list)
    valued: dict[str, dict[str, Value | None]] = defaultdict(dict)
    for subject, relation, object_ in contents.related:
        if relation not in vocabulary.relations or subject not in types or object_ not in types:
            return None
        related[relation].append((subject, object_))
    for (individual, property_), literals in contents.valued.items():
        term = vocabulary.properties.get(property_)
        if term is None or individual not in types:
            return None
        try:
            values = tuple(read_literal(each, term) for each in sorted(literals, key=str))
        except LiteralError:
            return None
        valued[property_][individual] = values[0] if term.functional and len(values) == 1 else values
    if not all(cls in classes for of in types.values() for cls in of):
        return None
    state = build_world_state(vocabulary, FactTables(types, related, valued))
    return state if satisfies_axioms(state) else None


def _sort_triples(triples: Iterable[ox.Triple]) -> _Contents:
    contents = _Contents(defaultdict(list), [], defaultdict(list), defaultdict(list), {})
    for triple in triples:
        subject, predicate, object_ = _iri(triple.subject), triple.predicate, triple.object
        if isinstance(object_, ox.Literal):
            if predicate == PREFIX:
                contents.prefixes[object_.value] = subject
            else:
                contents.valued[subject, predicate.value].append(object_)
        elif predicate == SUBCLASS:
            contents.classes[subject].append(_iri(object_))
        elif object_ == CLASS:
            contents.classes[subject].extend(())
        elif predicate == TYPE:
            contents.types[subject].append(_iri(object_))
        else:
            contents.related.append((subject, predicate.value, _iri(object_)))
    return contents


def _iri(node: ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple) -> str:
    """Return the IRI of a node; a blank node as its label, which no vocabulary has."""
    return node.value if isinstance(node, ox.NamedNode) else str(node)


def _changes(contents: _Contents, vocabulary: Vocabulary, problems: list[str]) -> Iterator[Change]:
    """Yield the facts as changes of an empty world; unknown terms and invalid literals are added to the problems."""
    short = vocabulary.short
    for individual, types in sorted(contents.types.items()):
        yield AddIndividual(individual, tuple(sorted(types)))
    for subject, relation, object_ in sorted(contents.related):
        if relation in vocabulary.relations:
            yield AddRelation(subject, relation, object_)
        else:
            problems.append(f"there is no relation {short(relation)}")
    for (individual, property_), literals in sorted(contents.valued.items()):
        term = vocabulary.properties.get(property_)
        if term is None:
            problems.append(f"there is no property {short(property_)}")
            continue
        try:
            values = tuple(read_literal(each, term) for each in sorted(literals, key=str))
        except LiteralError as error:
            problems.append(f"{short(individual)}.{short(property_)}: {error}")
        else:
            yield SetProperty(individual, property_, values[0] if term.functional and len(values) == 1 else values)
