"""What a vocabulary requires each individual of a class to state.

A vocabulary says so as OWL does, by a restriction above the class:

    :Surface rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :width ; owl:minCardinality 1 ] .

Reasoners conclude that every surface has some width, known or not; a scene must say which.
"""

from __future__ import annotations

from collections.abc import Mapping

from skillc_rdf.vocabulary.expressions import needs
from skillc_rdf.vocabulary.graph import Graph


def required(graph: Graph, cls: str, aliases: Mapping[str, str]) -> tuple[str, ...]:
    """Return the relations and properties that every individual of a class has at least one of, sorted."""
    return tuple(sorted({aliases.get(need.property, need.property) for need in needs(graph, cls)}))
