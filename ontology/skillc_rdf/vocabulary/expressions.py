"""What class expressions say that a vocabulary can hold: superclasses, what is disjoint, what each member has.

Expressions without a name stand above classes, in domains and ranges. Used are intersections, unions where a class is
one or a domain is, complements, and restrictions that ask for at least one value; the rest has no effect.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import pyoxigraph as ox

from skillc_rdf.vocabulary.graph import Graph, Node
from skillc_rdf.vocabulary.names import EQUAL_CLASS, OWL, SUBCLASS

AT_LEAST = tuple(
    f"{OWL}{name}" for name in ("minCardinality", "cardinality", "minQualifiedCardinality", "qualifiedCardinality")
)


class Needed(NamedTuple):
    """That each member of a class has so many values of a relation or property, those of `filler` where it is given."""

    property: str
    least: int
    filler: str | None


def parts(graph: Graph, cls: str) -> Iterator[Node]:
    """Yield what a class is below of, named or not: superclasses, equals, and what these are intersections of."""
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
    """Return the classes named above a class, those it is defined by too."""
    named = {node.value for node in parts(graph, cls) if isinstance(node, ox.NamedNode)}
    heads = graph.objects(cls, f"{OWL}intersectionOf")
    return named | {m.value for head in heads for m in graph.members(head) if isinstance(m, ox.NamedNode)}


def complements(graph: Graph, cls: str) -> set[str]:
    """Return the classes that a class is below the complement of."""
    return {other for node in parts(graph, cls) for other in graph.iris(node, f"{OWL}complementOf")}


def subclasses(graph: Graph, cls: str) -> set[str]:
    """Return the classes that a class is the union of, disjoint or not."""
    equals = [node for node in graph.objects(cls, EQUAL_CLASS) if isinstance(node, ox.BlankNode)]
    nodes: list[Node] = [*equals, ox.NamedNode(cls)]
    heads = [head for node in nodes for head in graph.objects(node, f"{OWL}unionOf")]
    heads += graph.objects(cls, f"{OWL}disjointUnionOf")
    return {m.value for head in heads for m in graph.members(head) if isinstance(m, ox.NamedNode)}


def alternatives(graph: Graph, iri: str, predicate: str) -> tuple[str, ...]:
    """Return the classes of a domain or range: those named, and the members of unions, sorted."""
    found = set(graph.iris(iri, predicate))
    for node in graph.objects(iri, predicate):
        heads = graph.objects(node, f"{OWL}unionOf") if isinstance(node, ox.BlankNode) else ()
        found |= {m.value for head in heads for m in graph.members(head) if isinstance(m, ox.NamedNode)}
    return tuple(sorted(found))


def needs(graph: Graph, cls: str) -> Iterator[Needed]:
    """Yield what each member of a class has at least one of."""
    for node in parts(graph, cls):
        if not isinstance(node, ox.BlankNode):
            continue
        for property_ in graph.iris(node, f"{OWL}onProperty"):
            yield from _needed(graph, node, property_)


def _needed(graph: Graph, node: Node, property_: str) -> Iterator[Needed]:
    for filler in graph.objects(node, f"{OWL}someValuesFrom"):
        yield Needed(property_, 1, filler.value if isinstance(filler, ox.NamedNode) else None)
    for predicate in AT_LEAST:
        count = graph.text(node, predicate)
        if count is not None and count.isdigit() and int(count) > 0:
            yield Needed(property_, int(count), next(iter(graph.iris(node, f"{OWL}onClass")), None))
