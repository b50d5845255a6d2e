"""The packaged Turtle files as RDF graphs."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from rdflib import Graph, Namespace

from skillc_ontology import catalogue

FILES = sorted(catalogue.ROOT.glob("**/*.ttl"))
SCENES = catalogue.scene_names()

SKILLC = Namespace("https://w3id.org/skillc/core#")
SKIROS = Namespace("http://rvmi.aau.dk/ontologies/skiros.owl#")
CORA = Namespace("http://www.inf.ufrgs.br/phi-group/ontologies/cora.owl#")
LAB = Namespace("http://example.org/lab#")


def name(path: Path) -> str:
    return str(path.relative_to(catalogue.ROOT))


@cache
def vocabulary() -> Graph:
    """Everything but scenes; not to be changed."""
    graph = Graph()
    for _, text in catalogue.vocabulary_files():
        graph.parse(data=text, format="turtle")
    return graph


def with_scene(scene: str) -> Graph:
    """A new graph with a scene and everything it speaks of."""
    return (vocabulary() + Graph()).parse(catalogue.scene_path(scene))
