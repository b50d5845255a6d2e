"""What a vocabulary requires each individual of a class to state.

A vocabulary says so as OWL does, by a restriction above the class:

    :Surface rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :width ; owl:minCardinality 1 ] .

Reasoners conclude that every surface has some width, known or not; a scene must say which.
"""

from __future__ import annotations

from collections.abc import Mapping

import pyoxigraph as ox

from skillc_compiler.vocabulary.graph import Graph, Node

OWL = "http://www.w3.org/2002/07/owl#"
SUBCLASS = "http://www.w3.org/2000/01/rdf-schema#subClassOf"
AT_LEAST = tuple(
    f"{OWL}{name}" for name in ("minCardinality", "cardinality", "minQualifiedCardinality", "qualifiedCardinality")
)


def required(graph: Graph, cls: str, aliases: Mapping[str, str]) -> tuple[str, ...]:
    """Return the relations and properties that every individual of a class has at least one of, sorted."""
    restrictions = (node for node in graph.objects(cls, SUBCLASS) if isinstance(node, ox.BlankNode))
    demanding = (node for node in restrictions if _demands(graph, node))
    found = {aliases.get(iri, iri) for node in demanding for iri in graph.iris(node, f"{OWL}onProperty")}
    return tuple(sorted(found))


def _demands(graph: Graph, restriction: Node) -> bool:
    """Whether a restriction asks for one value or more."""
    if graph.objects(restriction, f"{OWL}someValuesFrom"):
        return True
    counts = (graph.text(restriction, predicate) for predicate in AT_LEAST)
    return any(count is not None and count.isdigit() and int(count) > 0 for count in counts)
