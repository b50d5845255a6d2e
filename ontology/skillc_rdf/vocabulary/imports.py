"""The names of an ontology, and what it imports."""

from __future__ import annotations

from functools import lru_cache

import msgspec
import pyoxigraph as ox

from skillc_dsl.source import Source
from skillc_rdf.formats.read import UnreadableError, read_content
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.iris import OWL

CACHED = 64
"""The number of texts whose names and imports are cached."""
IMPORTS = f"{OWL}imports"


class Header(msgspec.Struct, frozen=True):
    """What a text says of its ontologies: `names` are their IRIs and version IRIs, without `#` or `/` at the end."""

    names: frozenset[str]
    imports: tuple[str, ...]


@lru_cache(maxsize=CACHED)
def read_header(source: Source, base: str) -> Header:
    """Read the names and imports of a text; relative IRIs are resolved against `base`. Empty if it is not RDF."""
    try:
        triples = read_content(source, base).triples
    except UnreadableError:
        return Header(frozenset(), ())
    imported = (each.object for each in triples if each.predicate.value == IMPORTS)
    named = dict.fromkeys(each.value for each in imported if isinstance(each, ox.NamedNode))
    return Header(ontology_names(Graph(triples)), tuple(named))


def ontology_names(graph: Graph) -> frozenset[str]:
    """Return the IRIs and version IRIs of the ontologies that a graph declares, without `#` or `/` at the end."""
    own = graph.instances(f"{OWL}Ontology")
    versions = (iri for each in own for iri in graph.iris(each, f"{OWL}versionIRI"))
    return frozenset(map(plain_name, (*own, *versions)))


def plain_name(iri: str) -> str:
    """Return the IRI of an ontology as it is compared: without `#` or `/` at the end."""
    return iri.rstrip("#/")
