"""Counts the axioms of an ontology by kind, those that are used and those without effect."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import pyoxigraph as ox

from skillc_rdf.vocabulary.axioms.rules import Rules
from skillc_rdf.vocabulary.axioms.unused import find_unused_kinds
from skillc_rdf.vocabulary.datatypes import FACETS
from skillc_rdf.vocabulary.expressions import AT_LEAST, superclass_nodes
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.iris import (
    COMPLEMENT,
    DISJOINT,
    DOMAIN,
    EQUAL_CLASS,
    EQUAL_PROPERTY,
    INVERSE,
    OWL,
    RANGE,
    SUBCLASS,
    SUBPROPERTY,
    TYPE,
)
from skillc_rdf.vocabulary.precedence import Split
from skillc_rdf.vocabulary.types import CHARACTERISTICS

_REQUIRED = {f"{OWL}someValuesFrom": "some value", **dict.fromkeys(AT_LEAST, "at least so many values")}
_NAMED = {
    SUBCLASS: "subclass",
    SUBPROPERTY: "sub-property",
    EQUAL_CLASS: "equal classes",
    EQUAL_PROPERTY: "equal properties",
    DISJOINT: "disjoint classes",
    COMPLEMENT: "disjoint classes",
    DOMAIN: "domain",
    RANGE: "range",
    INVERSE: "inverse",
    f"{OWL}disjointUnionOf": "disjoint union",
    f"{OWL}unionOf": "union",
    f"{OWL}intersectionOf": "intersection",
    **_REQUIRED,
    **dict.fromkeys(FACETS, "bound of a number"),
}
"""The kinds of the axioms that are used, or of their parts, by predicate."""
_DECLARED = {
    f"{OWL}{''.join(word.capitalize() for word in name.split('_'))}Property": name.replace("_", " ")
    for name in CHARACTERISTICS
} | {f"{OWL}AllDisjointClasses": "disjoint classes"}
"""The kinds of the axioms that are used, by the class of their subject."""


class AxiomCounts:
    """The axioms of an ontology by kind: `used`, and `unused`, which have no effect."""

    def __init__(self, part: Split, graph: Graph, rules: Rules) -> None:
        self.used, self.unused = Counter[str](), Counter[str]()
        above = {
            node
            for iri in graph.subjects(SUBCLASS) + graph.subjects(EQUAL_CLASS)
            for node in superclass_nodes(graph, iri)
        }
        for each in part.counting:
            if kinds := tuple(find_unused_kinds(each, graph, rules)):
                self.unused.update(kinds)
            elif rules.is_axiom(each):
                self.used["rule"] += 1
            elif each.predicate.value not in _REQUIRED or each.subject in above:
                self.used.update(_used_kinds(each))
            elif not rules.covers(each):
                self.unused[f"{_REQUIRED[each.predicate.value]}, within an expression"] += 1


def _used_kinds(triple: ox.Triple) -> Iterator[str]:
    said, object_ = triple.predicate.value, triple.object
    if said == TYPE and isinstance(object_, ox.NamedNode) and object_.value in _DECLARED:
        yield _DECLARED[object_.value]
    elif said in _NAMED and not (said in (SUBCLASS, EQUAL_CLASS, DOMAIN, RANGE) and isinstance(object_, ox.BlankNode)):
        yield _NAMED[said]
