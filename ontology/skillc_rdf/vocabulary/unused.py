"""Tells what a user's ontology says that has no effect here, once for each file: what is not used is not hidden."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.datatypes import FACETS
from skillc_rdf.vocabulary.graph import Graph, Node
from skillc_rdf.vocabulary.names import EQUAL_CLASS, OWL, SUBCLASS, TYPE
from skillc_rdf.vocabulary.precedence import Split
from skillc_rdf.vocabulary.reading import Ontology

PREDICATES = frozenset(
    f"{OWL}{name}"
    for name in (
        *("allValuesFrom", "maxCardinality", "maxQualifiedCardinality", "hasValue", "hasSelf", "hasKey"),
        *("propertyChainAxiom", "propertyDisjointWith", "sameAs", "differentFrom"),
    )
)
"""Each statement with one of these is an axiom, or the part of one, that is not used."""
CLASSES = frozenset(
    f"{OWL}{name}"
    for name in ("ReflexiveProperty", "AllDisjointProperties", "AllDifferent", "NegativePropertyAssertion")
)
"""Whatever is of these classes is an axiom that is not used."""
RESTRICTIONS = f"{OWL}withRestrictions"


def unused(parts: Iterable[Split], graph: Graph) -> Iterator[Diagnostic]:
    """Tell for each file how many of its axioms have no effect, and which kinds these are."""
    for part in parts:
        counts = Counter(kind for triple in part.counting for kind in _kinds(triple, graph))
        if not counts:
            continue
        listed = ", ".join(f"{count} {kind}" for kind, count in sorted(counts.items()))
        total = sum(counts.values())
        yield Diagnostic(
            "unused-axiom",
            Span(part.ontology.source.path, 1, 1, 1, 2),
            f"{total} axiom{'s' * (total > 1)} of this file {'have' if total > 1 else 'has'} no effect here: {listed}",
            help="the rest of the file is used; the reference of the language says what of OWL is",
            severity="warning",
        )


def imports(own: Sequence[Ontology], graph: Graph) -> Iterator[Diagnostic]:
    """Tell of imports that are not among the files: nothing is fetched."""
    here = {iri.rstrip("#/") for iri in graph.instances(f"{OWL}Ontology")}
    for ontology in own:
        for each in ontology.triples:
            if each.predicate.value != f"{OWL}imports" or not isinstance(each.object, ox.NamedNode):
                continue
            if each.object.value.rstrip("#/") not in here:
                yield Diagnostic(
                    "missing-import",
                    _place(ontology, each.object.value),
                    f"<{each.object.value}> is imported and not here",
                    help="nothing is fetched; put its file into the same folder if its terms are needed",
                    severity="warning",
                )


def _kinds(triple: ox.Quad, graph: Graph) -> Iterator[str]:
    said = triple.predicate.value
    if said in PREDICATES or (said == RESTRICTIONS and not _are_bounds(triple.object, graph)):
        yield _short(said)
    elif said == TYPE and isinstance(triple.object, ox.NamedNode) and triple.object.value in CLASSES:
        yield _short(triple.object.value)
    elif said in (SUBCLASS, EQUAL_CLASS) and isinstance(triple.object, ox.BlankNode):
        yield from _expression(triple.object, said, graph)


def _are_bounds(head: Node, graph: Graph) -> bool:
    """Whether all in a list of restrictions are bounds of numbers."""
    return all(any(graph.objects(each, facet) for facet in FACETS) for each in graph.members(head))


def _expression(node: ox.BlankNode, said: str, graph: Graph) -> Iterator[str]:
    """Yield what is not used of an expression above a class or equal to it."""
    if said == SUBCLASS and graph.objects(node, f"{OWL}unionOf"):
        yield "owl:unionOf above a class"
    if graph.objects(node, f"{OWL}oneOf") and not graph.objects(node, TYPE):
        yield "owl:oneOf"
    if said == EQUAL_CLASS and (graph.objects(node, f"{OWL}intersectionOf") or graph.objects(node, f"{OWL}onProperty")):
        yield "definition (nothing is recognised as a member by it)"


def _short(iri: str) -> str:
    return f"owl:{iri.removeprefix(OWL)}"


def _place(ontology: Ontology, iri: str) -> Span:
    at = max(ontology.source.text.find(iri), 0)
    line = ontology.source.text.count("\n", 0, at) + 1
    column = at - ontology.source.text.rfind("\n", 0, at)
    return Span(ontology.source.path, line, column, line, column + len(iri))
