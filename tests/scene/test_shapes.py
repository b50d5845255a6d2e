"""The SHACL shapes of the vocabulary: another tool that checks scenes by them finds what skillc finds."""

from __future__ import annotations

import os
from functools import cache
from random import Random

import pyshacl
import pytest
from rdflib import RDF, Graph, Literal, URIRef
from rdflib.namespace import XSD
from rdflib.term import Node

from skillc.services.library import libraries
from skillc_ontology import catalogue
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import read_documents
from skillc_runtime.scene.shapes import format_shapes

pytestmark = pytest.mark.reasoner

SEEDS = int(os.environ.get("SHAPE_SEEDS", "6"))
COVERED = {
    "missing-property",
    "wrong-data-type",
    "relation-domain",
    "relation-range",
    "property-domain",
    "functional-property",
    "functional-relation",
    "disjoint-classes",
}
"""What shapes say too; the rest stays with skillc."""
SHEETS = tuple(Document(name, text) for name, text in catalogue.vocabulary_files())


@cache
def shape_graph() -> Graph:
    return Graph().parse(data=format_shapes(libraries.load_vocabulary()), format="turtle")


@cache
def vocabulary_graph() -> Graph:
    graph = Graph()
    for sheet in SHEETS:
        graph.parse(data=sheet.text, format="turtle")
    return graph


def conforms(scene: Graph) -> bool:
    found, _, _ = pyshacl.validate(vocabulary_graph() + scene, shacl_graph=shape_graph(), inference="none")
    return bool(found)


def names(scene: Graph) -> set[str]:
    """Return the names of the problems that skillc finds."""
    document = Document("scene.ttl", scene.serialize(format="turtle"))
    return {problem.name for problem in read_documents([document, *SHEETS], libraries.load_vocabulary()).problems}


def mutated(graph: Graph, random: Random) -> None:
    """Take a statement away, or make one about individuals and terms of the graph."""
    triples = sorted(graph)
    subject, predicate, object_ = random.choice(triples)
    if random.random() < 0.5:
        graph.remove((subject, predicate, object_))
        return
    individuals: list[Node] = sorted({s for s, _, _ in triples})
    values: list[Node] = [Literal("word"), Literal(True), Literal("0.5", datatype=XSD.decimal), *individuals]
    if predicate == RDF.type:
        values = [object_]
    graph.add((random.choice(individuals), predicate, random.choice(values)))


def scene(name: str) -> Graph:
    return Graph().parse(data=catalogue.scene_path(name).read_text("utf-8"), format="turtle")


@pytest.mark.parametrize("name", catalogue.scene_names())
def test_shipped_scenes_conform(name: str) -> None:
    assert conforms(scene(name))


def test_shapes_find_what_skillc_finds() -> None:
    wrong = 0
    for seed in range(SEEDS):
        random = Random(seed)
        graph = scene(random.choice(["iiwa_table", "ur5e_whiteboard"]))
        mutated(graph, random)
        found = names(graph)
        if found - COVERED:
            continue
        assert conforms(graph) == (not found), (seed, found)
        wrong += bool(found)
    assert wrong > 0


def test_a_second_value_a_lost_one_and_one_out_of_bounds_do_not_conform() -> None:
    lab = "http://example.org/lab#"
    table = URIRef(f"{lab}Table-1")
    size = URIRef("http://rvmi.aau.dk/ontologies/skiros.owl#SizeX")
    assert not conforms(scene("iiwa_table").add((table, size, Literal(2.0))))
    assert not conforms(scene("iiwa_table").remove((table, size, None)))
    assert not conforms(scene("iiwa_table").set((table, size, Literal(-0.3))))
