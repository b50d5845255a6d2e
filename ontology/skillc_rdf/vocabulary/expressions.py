"""Reads OWL class expressions: superclasses, complements, required values.

Anonymous expressions occur above classes and in domains and ranges. Supported are intersections, unions that define a
class or a domain, complements, and restrictions that require at least one value; others have no effect.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import pyoxigraph as ox

from skillc_rdf.vocabulary.graph import Graph, Node
from skillc_rdf.vocabulary.iris import COMPLEMENT, EQUAL_CLASS, OWL, SUBCLASS
from skillc_rdf.vocabulary.types import THING, Vocabulary

AT_LEAST = tuple(
    f"{OWL}{name}" for name in ("minCardinality", "cardinality", "minQualifiedCardinality", "qualifiedCardinality")
)
MOST_PARTS = 100
"""The most anonymous parts of a domain or range that are read; a larger one restricts nothing."""
_COUNT = re.compile(r"[0-9]{1,9}")


class RequiredValue(NamedTuple):
    """Each member of a class has at least `least` values of a relation or property, of the class `filler` if given."""

    property: str
    least: int
    filler: str | None


def superclass_nodes(graph: Graph, cls: str) -> Iterator[Node]:
    """Yield what is above a class, named or anonymous: superclasses, equivalents, and members of intersections."""
    todo = [*graph.objects(cls, SUBCLASS), *graph.objects(cls, EQUAL_CLASS)]
    seen: set[Node] = set()
    while todo:
        node = todo.pop(0)
        if node in seen:
            continue
        seen.add(node)
        heads = graph.objects(node, f"{OWL}intersectionOf") if isinstance(node, ox.BlankNode) else ()
        todo += [member for head in heads for member in graph.members(head)]
        yield node


def superclasses(graph: Graph, cls: str) -> set[str]:
    """Return the named classes above a class, including those in its definition."""
    named = {node.value for node in superclass_nodes(graph, cls) if isinstance(node, ox.NamedNode)}
    heads = graph.objects(cls, f"{OWL}intersectionOf")
    return named | {m.value for head in heads for m in graph.members(head) if isinstance(m, ox.NamedNode)}


def complements(graph: Graph, cls: str) -> set[str]:
    """Return the classes of whose complements a class is a subclass, or of which it is the complement."""
    nodes: list[Node] = [ox.NamedNode(cls), *superclass_nodes(graph, cls)]
    return {other for node in nodes for other in graph.iris(node, COMPLEMENT)}


def subclasses(graph: Graph, cls: str) -> set[str]:
    """Return the classes of which a class is the union, disjoint or not."""
    equals = [node for node in graph.objects(cls, EQUAL_CLASS) if isinstance(node, ox.BlankNode)]
    nodes: list[Node] = [*equals, ox.NamedNode(cls)]
    heads = [head for node in nodes for head in graph.objects(node, f"{OWL}unionOf")]
    heads += graph.objects(cls, f"{OWL}disjointUnionOf")
    return {m.value for head in heads for m in graph.members(head) if isinstance(m, ox.NamedNode)}


def alternatives(graph: Graph, iri: str, predicate: str) -> tuple[str, ...]:
    """Return the classes of a domain or range, sorted: each subject or object is of one of them.

    Of an intersection, one of its classes counts. A union with a member of which no class is known restricts nothing.
    """
    found = (_containing(graph, node, {}) for node in graph.objects(iri, predicate))
    return tuple(sorted(frozenset[str]().union(*(each or () for each in found))))


def _containing(graph: Graph, node: Node, known: dict[Node, frozenset[str] | None]) -> frozenset[str] | None:
    """Return classes that together contain an expression; None if none but `owl:Thing` are known to.

    `known` has the expressions around it and their parts: a shared part is read once, one that contains itself ends.
    """
    if isinstance(node, ox.NamedNode):
        return None if node.value == THING else frozenset({node.value})
    if isinstance(node, ox.BlankNode) and node not in known and len(known) < MOST_PARTS:
        known[node] = None
        known[node] = _containing_parts(graph, node, known)
    return known.get(node)


def _containing_parts(graph: Graph, node: Node, known: dict[Node, frozenset[str] | None]) -> frozenset[str] | None:
    for head in graph.objects(node, f"{OWL}unionOf"):
        members = [_containing(graph, member, known) for member in graph.members(head)]
        named = [each for each in members if each is not None]
        return frozenset[str]().union(*named) if len(named) == len(members) else None
    for head in graph.objects(node, f"{OWL}intersectionOf"):
        parts = (_containing(graph, member, known) for member in graph.members(head))
        return next((each for each in parts if each is not None), None)
    return None


def required_values(graph: Graph, cls: str) -> Iterator[RequiredValue]:
    """Yield the values that each member of a class must have."""
    for node in superclass_nodes(graph, cls):
        if not isinstance(node, ox.BlankNode):
            continue
        for property_ in graph.iris(node, f"{OWL}onProperty"):
            yield from _needed(graph, node, property_)


def _needed(graph: Graph, node: Node, property_: str) -> Iterator[RequiredValue]:
    for filler in graph.objects(node, f"{OWL}someValuesFrom"):
        yield RequiredValue(property_, 1, filler.value if isinstance(filler, ox.NamedNode) else None)
    for predicate in AT_LEAST:
        count = graph.text(node, predicate)
        if count is not None and _COUNT.fullmatch(count) and int(count) > 0:
            yield RequiredValue(property_, int(count), next(iter(graph.iris(node, f"{OWL}onClass")), None))


def required_terms(graph: Graph, cls: str, aliases: Mapping[str, str]) -> tuple[str, ...]:
    """Return the relations and properties that every individual of a class has at least one of, sorted."""
    return tuple(sorted({aliases.get(need.property, need.property) for need in required_values(graph, cls)}))


def find_needs(graph: Graph, vocabulary: Vocabulary) -> dict[str, tuple[RequiredValue, ...]]:
    """Return the values that each member of a class must have, stated under any name of the class; no empty ones."""
    names: dict[str, list[str]] = {iri: [iri] for iri in vocabulary.classes}
    for alias, term in vocabulary.aliases.items():
        if term in names:
            names[term].append(alias)
    needs = ((iri, _needs(graph, vocabulary, same)) for iri, same in names.items())
    return {iri: found for iri, found in needs if found}


def _needs(graph: Graph, vocabulary: Vocabulary, names: Sequence[str]) -> tuple[RequiredValue, ...]:
    named = vocabulary.aliases.get
    return tuple(
        RequiredValue(named(need.property, need.property), need.least, named(need.filler or "", need.filler))
        for name in names
        for need in required_values(graph, name)
    )
