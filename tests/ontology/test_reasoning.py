"""Reasoners find the packaged ontology consistent with each scene, and nothing in it impossible."""

from __future__ import annotations

import shutil
from pathlib import Path

import owlrl
import pytest
from packaged import CORA, LAB, SCENES, SKILLC, SKIROS, vocabulary, with_scene
from rdflib import RDF, Graph, Literal, URIRef
from rdflib.term import Node

ERRORS = URIRef("http://www.daml.org/2002/03/agents/agent-ont#error")
SCENE = "iiwa_table.ttl"
BY_RULES = (SCENE, "ur5e_whiteboard.ttl", "two_robots.ttl", "panda_peg.ttl")
"""Scenes that rules judge, too: what they find, HermiT finds, which judges all scenes in less time."""
BAD: dict[str, tuple[Node, Node, Node]] = {
    "a thing that can be moved is a robot": (LAB["Eraser-1"], RDF.type, CORA.Robot),
    "a relation to a kind of thing that it does not lead to": (LAB["Cell"], SKILLC.hasArm, LAB["Eraser-1"]),
    "a thing contains what contains it": (LAB["Eraser-1"], SKIROS.contain, LAB["Cell"]),
}
BAD_VALUES: dict[str, tuple[Node, Node, Node]] = {
    "a text instead of a number": (LAB["Iiwa-1"], SKIROS.Weight, Literal("8 kg")),
    "a value that is not one of those there are": (LAB["Iiwa-1"], SKILLC.deviceState, Literal("Tired")),
    "a second value": (LAB["Eraser-1"], SKIROS.Weight, Literal(0.5)),
}

pytestmark = pytest.mark.reasoner
needs_java = pytest.mark.skipif(shutil.which("java") is None, reason="HermiT runs in Java")


def contradictions(graph: Graph) -> list[str]:
    """What the rules of OWL 2 RL find."""
    owlrl.DeductiveClosure(owlrl.OWLRL_Semantics).expand(graph)
    return [str(message) for message in graph.objects(None, ERRORS)]


def impossible(graph: Graph, folder: Path) -> list[str] | None:
    """The classes that nothing can belong to, by HermiT; None where the whole is inconsistent."""
    owlready2 = pytest.importorskip("owlready2")
    file = folder / "all.nt"
    graph.serialize(file, format="nt", encoding="utf-8")
    world = owlready2.World()
    with world.get_ontology(file.as_uri()).load():
        try:
            owlready2.sync_reasoner_hermit(world, debug=0)
        except owlready2.OwlReadyInconsistentOntologyError:
            return None
    return [each.iri for each in world.inconsistent_classes()]


@pytest.mark.parametrize("scene", BY_RULES)
def test_rules_find_no_contradiction(scene: str) -> None:
    graph = with_scene(scene)
    assert contradictions(graph) == []
    assert set(graph.subjects(SKILLC.within, LAB["Scene-1"])), "the rules ran"


@pytest.mark.parametrize("wrong", BAD.values(), ids=BAD)
def test_rules_find_what_is_wrong(wrong: tuple[Node, Node, Node]) -> None:
    assert contradictions(with_scene(SCENE).add(wrong)) != []


@needs_java
@pytest.mark.parametrize("scene", SCENES)
def test_a_reasoner_finds_the_whole_consistent(scene: str, tmp_path: Path) -> None:
    assert impossible(with_scene(scene), tmp_path) == []


@needs_java
def test_a_reasoner_finds_every_class_possible(tmp_path: Path) -> None:
    assert impossible(vocabulary(), tmp_path) == []


@needs_java
@pytest.mark.parametrize("wrong", (BAD | BAD_VALUES).values(), ids=BAD | BAD_VALUES)
def test_a_reasoner_finds_what_is_wrong(wrong: tuple[Node, Node, Node], tmp_path: Path) -> None:
    assert impossible(with_scene(SCENE).add(wrong), tmp_path) is None
