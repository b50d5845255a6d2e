"""From Turtle texts to a Vocabulary: classes, relations and properties with their axioms."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from itertools import combinations

import pyoxigraph as ox

from skillc_compiler.library.vocabulary import (
    THING,
    ClassTerm,
    Position,
    PropertyTerm,
    RelationTerm,
    Signature,
    Vocabulary,
)
from skillc_compiler.vocabulary.datatypes import value_type, value_types_known
from skillc_compiler.vocabulary.graph import Graph, read
from skillc_compiler.vocabulary.mandatory import required
from skillc_compiler.vocabulary.positions import positions
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.source import Source

OWL = "http://www.w3.org/2002/07/owl#"
RDFS = "http://www.w3.org/2000/01/rdf-schema#"
REPLACED = "http://purl.org/dc/terms/isReplacedBy"
VANN = "http://purl.org/vocab/vann/"
SKILLC = "https://w3id.org/skillc/core#"
KINDS = ("Class", "ObjectProperty", "DatatypeProperty")


def load(sources: Sequence[Source]) -> Outcome[Vocabulary]:
    """Read vocabularies in Turtle. Diagnostics: a broken file, a property with an unknown range."""
    graph = read(sources)
    places = positions(sources)
    aliases = _aliases(graph.value)
    untyped = value_types_known(graph.value, graph.value.instances(f"{OWL}DatatypeProperty"), places)
    vocabulary = Vocabulary(
        prefixes=_prefixes(graph.value),
        aliases=aliases,
        deprecated=_deprecated(graph.value),
        classes=_classes(graph.value, aliases, places),
        relations=_relations(graph.value, aliases, places),
        properties=_properties(graph.value, aliases, places),
    )
    return Outcome(vocabulary, (*graph.diagnostics, *untyped))


def _prefixes(graph: Graph) -> dict[str, str]:
    pairs = (
        (graph.text(iri, f"{VANN}preferredNamespacePrefix"), graph.text(iri, f"{VANN}preferredNamespaceUri"))
        for iri in graph.instances(f"{OWL}Ontology")
    )
    return {prefix: base for prefix, base in sorted((p or "", b or "") for p, b in pairs) if prefix and base}


def _aliases(graph: Graph) -> dict[str, str]:
    terms = [iri for kind in KINDS for iri in graph.instances(f"{OWL}{kind}")]
    named = ((iri, graph.iris(iri, f"{SKILLC}aliasOf")) for iri in terms)
    return {iri: others[0] for iri, others in sorted(named) if others}


def _deprecated(graph: Graph) -> dict[str, str]:
    terms = [iri for kind in KINDS for iri in graph.instances(f"{OWL}{kind}")]
    marked = (iri for iri in terms if graph.text(iri, f"{OWL}deprecated") in ("true", "1"))
    return {iri: next(iter(graph.iris(iri, REPLACED)), "") for iri in sorted(marked)}


def _classes(graph: Graph, aliases: Mapping[str, str], places: Mapping[str, Position]) -> dict[str, ClassTerm]:
    disjoint = _disjoint(graph)
    return {
        iri: ClassTerm(
            iri=iri,
            parents=tuple(aliases.get(p, p) for p in graph.iris(iri, f"{RDFS}subClassOf") if p != THING),
            disjoint=tuple(sorted(disjoint[iri])),
            required=required(graph, iri, aliases),
            comment=graph.text(iri, f"{RDFS}comment") or "",
            source=places.get(iri),
        )
        for iri in graph.instances(f"{OWL}Class")
        if iri not in aliases
    }


def _disjoint(graph: Graph) -> dict[str, set[str]]:
    disjoint: dict[str, set[str]] = defaultdict(set)
    for iri in graph.instances(f"{OWL}Class"):
        disjoint[iri].update(graph.iris(iri, f"{OWL}disjointWith"))
    for axiom in graph.nodes(f"{OWL}AllDisjointClasses"):
        for head in graph.objects(axiom, f"{OWL}members"):
            members = [m.value for m in graph.members(head) if isinstance(m, ox.NamedNode)]
            for one, other in combinations(members, 2):
                disjoint[one].add(other)
    return disjoint


def _relations(graph: Graph, aliases: Mapping[str, str], places: Mapping[str, Position]) -> dict[str, RelationTerm]:
    inverse = _inverses(graph)
    terms = (iri for iri in graph.instances(f"{OWL}ObjectProperty") if iri not in aliases)
    return {iri: _relation(graph, iri, inverse.get(iri), places.get(iri)) for iri in terms}


def _inverses(graph: Graph) -> dict[str, str]:
    stated = {
        iri: inverse
        for iri in graph.instances(f"{OWL}ObjectProperty")
        for inverse in graph.iris(iri, f"{OWL}inverseOf")[:1]
    }
    return {**{inverse: iri for iri, inverse in stated.items()}, **stated}


def _relation(graph: Graph, iri: str, inverse: str | None, place: Position | None) -> RelationTerm:
    return RelationTerm(
        iri=iri,
        signatures=_signatures(graph, iri, inverse),
        parents=graph.iris(iri, f"{RDFS}subPropertyOf"),
        inverse=inverse,
        functional=_is(graph, iri, "FunctionalProperty"),
        inverse_functional=_is(graph, iri, "InverseFunctionalProperty"),
        symmetric=_is(graph, iri, "SymmetricProperty"),
        transitive=_is(graph, iri, "TransitiveProperty"),
        asymmetric=_is(graph, iri, "AsymmetricProperty"),
        irreflexive=_is(graph, iri, "IrreflexiveProperty"),
        comment=graph.text(iri, f"{RDFS}comment") or "",
        source=place,
    )


def _signatures(graph: Graph, iri: str, inverse: str | None) -> tuple[Signature, ...]:
    """A relation without domain and range has those of its inverse, turned round."""
    domains, ranges = graph.iris(iri, f"{RDFS}domain"), graph.iris(iri, f"{RDFS}range")
    if inverse and not domains and not ranges:
        domains, ranges = graph.iris(inverse, f"{RDFS}range"), graph.iris(inverse, f"{RDFS}domain")
    return tuple(Signature(domain, range_) for domain in domains or (THING,) for range_ in ranges or (THING,))


def _properties(graph: Graph, aliases: Mapping[str, str], places: Mapping[str, Position]) -> dict[str, PropertyTerm]:
    found: dict[str, PropertyTerm] = {}
    for iri in graph.instances(f"{OWL}DatatypeProperty"):
        typed = value_type(graph, iri)
        if iri not in aliases and typed is not None:
            found[iri] = PropertyTerm(
                iri=iri,
                domains=graph.iris(iri, f"{RDFS}domain") or (THING,),
                type=typed.type,
                values=typed.values,
                functional=_is(graph, iri, "FunctionalProperty"),
                computed_by=graph.text(iri, f"{SKILLC}computedBy"),
                comment=graph.text(iri, f"{RDFS}comment") or "",
                source=places.get(iri),
            )
    return found


def _is(graph: Graph, iri: str, characteristic: str) -> bool:
    return f"{OWL}{characteristic}" in graph.iris(iri, "http://www.w3.org/1999/02/22-rdf-syntax-ns#type")
