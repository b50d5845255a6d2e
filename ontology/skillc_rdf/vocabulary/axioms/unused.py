"""Reports axioms of a user's ontologies that have no effect here, and missing imports."""

from __future__ import annotations

import posixpath
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from urllib.parse import unquote

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.axioms.rules import ONE_OF, Rules
from skillc_rdf.vocabulary.datatypes import FACETS, read_bound
from skillc_rdf.vocabulary.graph import Graph, Node
from skillc_rdf.vocabulary.imports import IMPORTS, ontology_names, plain_name
from skillc_rdf.vocabulary.iris import COMPLEMENT, DISJOINT, EQUAL_CLASS, OWL, SUBCLASS, TYPE
from skillc_rdf.vocabulary.precedence import Split
from skillc_rdf.vocabulary.reading import Ontology

PREDICATES = frozenset(
    f"{OWL}{name}"
    for name in (
        *("allValuesFrom", "maxCardinality", "maxQualifiedCardinality", "hasValue", "hasSelf", "hasKey"),
        *("propertyChainAxiom", "propertyDisjointWith", "sameAs", "differentFrom"),
    )
)
"""Statements with these predicates are (parts of) axioms without effect."""
CLASSES = {
    **{
        f"{OWL}{name}": f"owl:{name}"
        for name in ("ReflexiveProperty", "AllDisjointProperties", "AllDifferent", "NegativePropertyAssertion")
    },
    "http://www.w3.org/2003/11/swrl#Imp": "rule (swrl:Imp)",
    **{f"http://www.w3.org/ns/shacl#{name}": f"shape (sh:{name})" for name in ("NodeShape", "PropertyShape")},
}
"""Instances of these classes are axioms without effect."""
COVERING = "owl:complementOf (that everything is of one of both)"
RESTRICTIONS = f"{OWL}withRestrictions"


def report_unused_axioms(parts: Iterable[Split], graph: Graph, rules: Rules) -> Iterator[Diagnostic]:
    """Report, once per file, the number of axioms without effect, by kind."""
    for part in parts:
        counts = Counter(kind for triple in part.counting for kind in find_unused_kinds(triple, graph, rules))
        if not counts:
            continue
        listed = ", ".join(f"{count} {kind}" for kind, count in sorted(counts.items()))
        total = sum(counts.values())
        yield Diagnostic(
            "unused-axiom",
            Span(part.ontology.source.path, 1, 1, 1, 2),
            f"{total} axiom{'s' * (total > 1)} of this file {'have' if total > 1 else 'has'} no effect here: {listed}",
            help="the rest of the file is used; the language reference lists the supported part of OWL",
            severity="warning",
        )


def report_missing_imports(own: Sequence[Ontology], graph: Graph) -> Iterator[Diagnostic]:
    """Report imports that are not among the files: nothing is downloaded."""
    names = ontology_names(graph)
    paths = tuple(posixpath.normpath(f"/{each.source.path}") for each in own)
    for ontology in own:
        for each in ontology.triples:
            if each.predicate.value != IMPORTS or not isinstance(each.object, ox.NamedNode):
                continue
            iri = each.object.value
            of_file = iri.startswith("file:") and unquote(iri).endswith(paths)
            if plain_name(iri) not in names and not of_file:
                yield Diagnostic(
                    "missing-import",
                    _place(ontology, iri),
                    f"<{iri}> is imported but missing",
                    help="if its terms are needed, save it in the same folder, or name its file in a catalog-v001.xml "
                    "beside this one or under [imports] in skillc.toml; nothing is downloaded",
                    severity="warning",
                )


def find_unused_kinds(triple: ox.Triple, graph: Graph, rules: Rules) -> Iterator[str]:
    """Yield the kinds of axioms without effect of which a statement is the one that is counted."""
    said = triple.predicate.value
    if rules.covers(triple):
        return
    if said in PREDICATES or (said == RESTRICTIONS and not _are_bounds(triple.object, graph)):
        yield _short(said)
    elif said == TYPE and isinstance(triple.object, ox.NamedNode) and triple.object.value in CLASSES:
        yield CLASSES[triple.object.value]
    elif said in (SUBCLASS, EQUAL_CLASS, DISJOINT) and isinstance(triple.subject, ox.BlankNode):
        yield "axiom about an expression"
    elif said == DISJOINT and isinstance(triple.object, ox.BlankNode):
        yield "owl:disjointWith an expression"
    elif said in (SUBCLASS, EQUAL_CLASS) and isinstance(triple.object, ox.BlankNode):
        yield from _expression(triple.object, said, graph)
    elif said == COMPLEMENT and isinstance(triple.subject, ox.NamedNode):
        yield COVERING
    elif said == ONE_OF and isinstance(triple.subject, ox.NamedNode):
        yield _short(said)


def _are_bounds(head: Node, graph: Graph) -> bool:
    """Whether all restrictions in a list are bounds of numbers."""
    return all(
        any(read_bound(end) is not None for facet in FACETS for end in graph.objects(each, facet))
        for each in graph.members(head)
    )


def _expression(node: ox.BlankNode, said: str, graph: Graph) -> Iterator[str]:
    """Yield the kinds of axioms without effect in an expression above or equivalent to a class."""
    if said == SUBCLASS and graph.objects(node, f"{OWL}unionOf"):
        yield "owl:unionOf above a class"
    if said == EQUAL_CLASS and graph.objects(node, COMPLEMENT):
        yield COVERING
    if graph.objects(node, ONE_OF) and not graph.objects(node, TYPE):
        yield "owl:oneOf"
    if said == EQUAL_CLASS and (graph.objects(node, f"{OWL}intersectionOf") or graph.objects(node, f"{OWL}onProperty")):
        yield "definition (members are not inferred from it)"


def _short(iri: str) -> str:
    return f"owl:{iri.removeprefix(OWL)}"


def _place(ontology: Ontology, iri: str) -> Span:
    at = max(ontology.source.text.find(iri), 0)
    line = ontology.source.text.count("\n", 0, at) + 1
    column = at - ontology.source.text.rfind("\n", 0, at)
    return Span(ontology.source.path, line, column, line, column + len(iri))
