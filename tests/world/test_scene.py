"""Scenes in Turtle: what is understood, and each mistake with its place and words."""

from pathlib import Path

import pytest

from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.documents import Document, SceneError
from skillc_runtime.scene.load import load_documents, load_scene
from skillc_runtime.world.state.elements import elements_of
from skillc_runtime.world.state.world_state import WorldState
from world.lab import NS, VOCABULARY, iri

PREFIXES = f"""@prefix t: <{NS}> . @prefix lab: <http://example.org/lab#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> . @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
"""
HEADER = PREFIXES.count("\n")
LAB = "http://example.org/lab#"


def world(text: str, vocabulary: Vocabulary = VOCABULARY) -> WorldState:
    """Load a scene given as text below the usual prefixes."""
    return load_documents([Document("scene.ttl", PREFIXES + text)], vocabulary)


GOOD = """lab:Table a t:Location ; rdfs:label "a table; with. marks" ; t:contain lab:Box, lab:Eraser .   # a comment . ;
lab:Box a t:Product , owl:NamedIndividual ; t:weight 3 ; t:label "red", 'heavy' .
lab:Eraser a t:Eraser ; t:weight "0.5"^^xsd:float .
lab:Other a t:Eraser ; t:weight 1.5e0 . <http://example.org/lab#Board> a t:Board ; t:isClean false .
"""


def test_individuals_relations_and_every_kind_of_number_are_read() -> None:
    state = world(GOOD)
    assert state.objects(LAB + "Table", iri("contain")) == {LAB + "Box", LAB + "Eraser"}
    weights = [state.value(LAB + name, iri("weight")) for name in ("Box", "Eraser", "Other")]
    assert weights == [3.0, 0.5, 1.5] and all(isinstance(weight, float) for weight in weights)
    assert state.value(LAB + "Box", iri("label")) == ("red", "heavy")
    assert state.value(LAB + "Board", iri("isClean")) is False
    assert state.vocabulary.short(LAB + "Box") == "lab:Box"


def test_skiros_classes_and_templates_are_understood() -> None:
    state = world(
        """t:Crate a owl:class ; rdfs:subClassOf t:Product .
        lab:Crate-1 a t:Crate ; skiros:hasTemplate lab:Pattern .
        lab:Pattern a skiros:Template ; t:weight 8.0 ; t:colour "red" .
        """
    )
    assert state.is_a(LAB + "Crate-1", iri("Product"))
    assert state.individuals == {LAB + "Crate-1"}


def test_other_names_of_terms_are_accepted() -> None:
    aliases = {"http://rvmi.aau.dk/ontologies/skiros.owl#Workstation": iri("Location"), iri("holds"): iri("contain")}
    vocabulary = Vocabulary(
        aliases=aliases, classes=VOCABULARY.classes, relations=VOCABULARY.relations, properties=VOCABULARY.properties
    )
    state = world("lab:W a skiros:Workstation ; t:holds lab:E . lab:E a t:Eraser .", vocabulary)
    assert state.objects(LAB + "W", iri("contain")) == {LAB + "E"} and state.is_a(LAB + "W", iri("Location"))


BAD = [
    ("lab:T a t:Locatoin .", (1, 9), "unknown-class", "there is no class t:Locatoin", "did you mean `t:Location`?"),
    (
        "\nlab:T a t:Location ;\n  t:contian lab:T2 . lab:T2 a t:Product .",
        (3, 3),
        "unknown-relation",
        "t:contian",
        "t:contain",
    ),
    ("lab:B a t:Product ; t:wieght 3 .", (1, 21), "unknown-property", "t:wieght", "t:weight"),
    (
        "lab:T a t:Location ; t:contain lab:Bok . lab:Box a t:Product .",
        (1, 32),
        "unknown-individual",
        "lab:Bok",
        "lab:Box`?",
    ),
    (
        "lab:A a t:Arm ; t:hasGripper lab:Qqq . lab:G a t:WsgGripper . lab:B a t:Board .",
        (1, 30),
        "unknown-individual",
        "lab:Qqq",
        "there is `lab:G`",
    ),
    ("lab:B t:weight 3 .", (1, 1), "unknown-individual", "lab:B has no class", "say what it is"),
    ('lab:B a t:Product ; t:weight "3 kg" .', (1, 30), "wrong-data-type", "t:weight: it takes a number", ""),
    ("lab:B a t:Product ; t:weight lab:B .", (1, 30), "wrong-data-type", "it has a value", "write a number"),
    ('lab:B a t:Product ; t:weight "NaN"^^xsd:double .', (1, 30), "wrong-data-type", "NaN", ""),
    ('lab:B a t:Product ; t:weight "INF"^^xsd:double .', (1, 30), "wrong-data-type", "infinity", ""),
    ("lab:T a t:Location ; t:contain 3 .", (1, 32), "relation-range", "leads to an individual", "name an individual"),
    ("lab:B a t:Product ; t:weight 3 ;\n t:weight 4.0 .", (2, 11), "functional-property", "3 and 4", "keep one"),
    ('lab:A a t:Arm ; t:state "Tired" .', (1, 25), "wrong-data-type", "one of Idle, Fault", ""),
    ("lab:T a t:Location ; t:load 3 .", (1, 29), "computed-property", "cannot be set", ""),
    (
        "lab:T a t:Location ; t:weight 3 .",
        (1, 22),
        "property-domain",
        "it belongs to t:Product; lab:T is a t:Location",
        "",
    ),
    (
        "lab:B a t:Board ; t:hasGripper lab:G . lab:G a t:Gripper .",
        (1, 19),
        "relation-domain",
        "(t:Arm, t:Gripper)",
        "",
    ),
    ("lab:X a t:Location, t:Robot .", (1, 21), "disjoint-classes", "both a t:Location and a t:Robot", ""),
    (
        "lab:E a t:Eraser . lab:S a t:Location ; t:contain lab:E . lab:T a t:Location ; t:contain lab:E .",
        (1, 90),
        "functional-relation",
        "t:contain is inverse functional, and `lab:T t:contain lab:E` is stated too",
        "",
    ),
    ("lab:T a t:Location ; t:contain lab:T .", (1, 32), "irreflexive-relation", "nothing has it to itself", ""),
    ("lab:T a t:Location ;\n t:contain ; .", (2, 2), "broken-turtle", "`t:contain` has no value", ""),
    ("lab:T a t:Locat", (1, 9), "broken-turtle", "a `.` is missing", ""),
]


@pytest.mark.parametrize(("text", "place", "name", "message", "help_"), BAD)
def test_a_mistake_is_reported_with_its_place(
    text: str, place: tuple[int, int], name: str, message: str, help_: str
) -> None:
    with pytest.raises(SceneError) as caught:
        world(text)
    first = next(each for each in caught.value.problems if each.name == name)
    assert (first.span.line - HEADER, first.span.column) == place
    assert message in first.message and help_ in first.help


def test_an_unknown_term_that_is_used_many_times_is_one_mistake() -> None:
    with pytest.raises(SceneError) as caught:
        world(
            "lab:T a t:Location .\n" + "".join(f"lab:T t:contian lab:B{n} . lab:B{n} a t:Product .\n" for n in range(9))
        )
    (one,) = caught.value.problems
    assert "which is used 9 times" in one.message and "t:contain" in one.help
    assert [each.span.line - HEADER for each in one.labels] == [3, 4, 5]


def test_all_mistakes_are_reported_and_one_mistake_once() -> None:
    with pytest.raises(SceneError) as caught:
        world("lab:T a t:Locatoin ; t:contain lab:B .\nlab:B a t:Product ; t:wieght 3 ; t:weight true .")
    assert [(each.span.line - HEADER, each.name) for each in caught.value.problems] == [
        (1, "unknown-class"),
        (2, "unknown-property"),
        (2, "wrong-data-type"),
    ]


@pytest.mark.parametrize("content", [b"\xff\xfe", bytes(range(256)) * 2, None])
def test_a_file_that_cannot_be_read_is_an_error_of_the_scene(tmp_path: Path, content: bytes | None) -> None:
    path = tmp_path / "scene.ttl"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(SceneError, match="cannot read"):
        load_scene(path, VOCABULARY)


def test_the_listing_shows_what_was_written() -> None:
    state = world(GOOD)
    listed = {each.iri: each for each in elements_of(state, state.individuals)}
    assert listed[LAB + "Table"].relations == ((iri("contain"), LAB + "Box"), (iri("contain"), LAB + "Eraser"))
    assert listed[LAB + "Eraser"].types == (iri("Eraser"),)
    assert [(each.property, each.value) for each in listed[LAB + "Eraser"].properties] == [(iri("weight"), 0.5)]
