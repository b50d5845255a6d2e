"""Vocabularies under which something cannot be are told at the line that makes it so, sound ones are not."""

from __future__ import annotations

import pytest

from skillc_dsl.source import Source
from vocabularies.reading import HEAD, T, beside, told

ABOVE = "t:A a owl:Class . t:B a owl:Class ; owl:disjointWith t:A . t:C a owl:Class .\n"
SOME = "[ a owl:Restriction ; owl:onProperty t:r ; owl:someValuesFrom %s ]"
WRONG = {
    "two disjoint parents": (
        ABOVE + "t:X a owl:Class ;\n rdfs:subClassOf t:A ;\n rdfs:subClassOf t:B .",
        "impossible-class",
        3,
    ),
    "disjoint far above": (
        ABOVE + "t:A1 a owl:Class ; rdfs:subClassOf t:A . t:B1 a owl:Class ; rdfs:subClassOf t:B .\n"
        "t:X a owl:Class ; rdfs:subClassOf t:A1, t:B1 .\nt:Y a owl:Class ; rdfs:subClassOf t:X .",
        "impossible-class",
        3,
    ),
    "disjoint with a shipped one": (
        "t:X a owl:Class ; rdfs:subClassOf skiros:Product ;\n owl:disjointWith sumo:Object .",
        "impossible-class",
        1,
    ),
    "complement of its own parent": (
        ABOVE + "t:X a owl:Class ; rdfs:subClassOf t:A, [ owl:complementOf t:A ] .",
        "impossible-class",
        2,
    ),
    "below a class and its complement": (
        ABOVE + "t:C owl:complementOf t:B .\nt:X a owl:Class ; rdfs:subClassOf t:B, t:C .",
        "impossible-class",
        3,
    ),
    "listed as disjoint": (
        ABOVE + "[] a owl:AllDisjointClasses ; owl:members ( t:A t:C ) .\nt:X a owl:Class ; rdfs:subClassOf t:A, t:C .",
        "impossible-class",
        3,
    ),
    "needs what it cannot have": (
        ABOVE
        + "t:r a owl:ObjectProperty ; rdfs:domain t:A .\nt:X a owl:Class ; rdfs:subClassOf t:B, "
        + SOME % "t:C"
        + " .",
        "impossible-class",
        3,
    ),
    "needs what it does not lead to": (
        ABOVE + "t:r a owl:ObjectProperty ; rdfs:range t:A .\nt:X a owl:Class ; rdfs:subClassOf " + SOME % "t:B" + " .",
        "impossible-class",
        3,
    ),
    "needs two different ones of one": (
        ABOVE + "t:r a owl:ObjectProperty, owl:FunctionalProperty .\n"
        f"t:X a owl:Class ; rdfs:subClassOf {SOME % 't:A'}, {SOME % 't:B'} .",
        "impossible-class",
        3,
    ),
    "below nothing": (
        "t:X a owl:Class ;\n rdfs:subClassOf owl:Nothing .\nt:Y a owl:Class ; rdfs:subClassOf t:Z . t:Z a owl:Class .",
        "impossible-class",
        2,
    ),
    "symmetric and asymmetric": (
        "t:r a owl:ObjectProperty, owl:SymmetricProperty, owl:AsymmetricProperty .",
        "impossible-relation",
        1,
    ),
    "symmetric below an asymmetric one": (
        "t:r a owl:ObjectProperty, owl:AsymmetricProperty .\nt:s a owl:ObjectProperty, owl:SymmetricProperty ;\n"
        " rdfs:subPropertyOf t:r .",
        "impossible-relation",
        2,
    ),
    "domain apart from that above": (
        ABOVE + "t:r a owl:ObjectProperty ; rdfs:domain t:A .\nt:s a owl:ObjectProperty ; rdfs:domain t:B ;\n"
        " rdfs:subPropertyOf t:r .",
        "impossible-relation",
        4,
    ),
    "ends apart from those of the inverse": (
        ABOVE + "t:r a owl:ObjectProperty ; rdfs:domain t:A .\n"
        "t:s a owl:ObjectProperty ; owl:inverseOf t:r ;\n rdfs:range t:B .",
        "impossible-relation",
        2,
    ),
    "both alternatives apart from the domain above": (
        ABOVE + "t:D a owl:Class ; rdfs:subClassOf t:B . t:r a owl:ObjectProperty ; rdfs:domain t:A .\n"
        "t:s a owl:ObjectProperty ; rdfs:domain [ owl:unionOf ( t:D [ owl:intersectionOf ( t:B t:C ) ] ) ] ;\n"
        " rdfs:subPropertyOf t:r .",
        "impossible-relation",
        4,
    ),
    "two domains apart": (
        ABOVE + "t:s a owl:ObjectProperty ; rdfs:domain\n t:A, t:B .",
        "impossible-relation",
        3,
    ),
    "two kinds of values": (
        "t:p a owl:DatatypeProperty ;\n rdfs:range xsd:double, xsd:string .",
        "impossible-relation",
        1,
    ),
}
SOUND = {
    "parents that meet": ABOVE + "t:X a owl:Class ; rdfs:subClassOf t:A, t:C .",
    "needs what fits": ABOVE
    + "t:r a owl:ObjectProperty ; rdfs:domain t:A .\nt:X a owl:Class ; rdfs:subClassOf t:A, "
    + SOME % "t:B"
    + " .",
    "a symmetric relation above an asymmetric one": "t:r a owl:ObjectProperty, owl:SymmetricProperty .\n"
    "t:s a owl:ObjectProperty, owl:AsymmetricProperty ; rdfs:subPropertyOf t:r .",
    "an alternative that fits": ABOVE
    + "t:r a owl:ObjectProperty ; rdfs:domain [ a owl:Class ; owl:unionOf ( t:A t:C ) ] .\n"
    "t:s a owl:ObjectProperty ; rdfs:domain t:B ; rdfs:subPropertyOf t:r .",
    "an alternative that is an expression": ABOVE
    + "t:r a owl:ObjectProperty ; rdfs:domain [ a owl:Class ; owl:unionOf ( t:A [ owl:intersectionOf ( t:B "
    "[ owl:complementOf t:C ] ) ] ) ] .\nt:s a owl:ObjectProperty ; rdfs:domain t:B ; rdfs:subPropertyOf t:r .",
    "an alternative of which nothing is known": ABOVE
    + "t:r a owl:ObjectProperty ; rdfs:range [ a owl:Class ; owl:unionOf ( t:A [ owl:complementOf t:C ] ) ] .\n"
    "t:s a owl:ObjectProperty ; rdfs:range t:B ; rdfs:subPropertyOf t:r .",
    "anything as an alternative": ABOVE
    + "t:r a owl:ObjectProperty ; rdfs:range [ a owl:Class ; owl:unionOf ( t:A owl:Thing ) ] .\n"
    "t:s a owl:ObjectProperty ; rdfs:range t:B ; rdfs:subPropertyOf t:r .",
    "a union of itself": ABOVE
    + "t:r a owl:ObjectProperty ; rdfs:range _:u . _:u a owl:Class ; owl:unionOf ( t:A _:u ) .\n"
    "t:s a owl:ObjectProperty ; rdfs:range t:B ; rdfs:subPropertyOf t:r .",
    "texts twice": "t:p a owl:DatatypeProperty ; rdfs:range xsd:string, rdfs:Literal .",
}


@pytest.mark.slow
@pytest.mark.parametrize("case", WRONG)
def test_what_cannot_be_is_told_at_its_line(case: str) -> None:
    text, name, line = WRONG[case]
    errors = [each for each in told(text) if each[0] == "error"]
    assert errors == [("error", name, line)]


@pytest.mark.parametrize("case", SOUND)
def test_what_can_be_is_not_told(case: str) -> None:
    assert told(SOUND[case]) == []


def test_classes_below_each_other_are_one() -> None:
    text = "t:A a owl:Class ; rdfs:subClassOf t:B .\nt:B a owl:Class ; rdfs:subClassOf t:C .\n"
    text += 't:C a owl:Class ; rdfs:subClassOf t:A ; rdfs:comment "x" .\nt:D a owl:Class ; rdfs:subClassOf t:C .'
    assert told(text) == [("warning", "class-cycle", 1)]
    found = beside(Source("t.ttl", HEAD + text)).value
    assert {found.aliases[f"{T}{name}"] for name in "BC"} == {f"{T}A"}
    assert found.classes[f"{T}D"].parents == (f"{T}A",) and found.classes[f"{T}A"].parents == ()


def test_what_would_make_two_shipped_classes_one_is_told_and_not_done() -> None:
    text = "t:X a owl:Class ; owl:equivalentClass skiros:Product, skiros:PlacingPose ."
    assert [(name, line) for severity, name, line in told(text) if severity == "error"] == [("impossible-class", 1)]


def test_the_message_says_which_classes_have_nothing_in_common_and_where() -> None:
    problem = beside(Source("t.ttl", HEAD + WRONG["two disjoint parents"][0])).diagnostics[0]
    assert problem.message == ("nothing can be `t:X`: it is below `t:A` and `t:B`, which are disjoint")
    assert [(label.span.path, label.span.line - HEAD.count("\n")) for label in problem.labels] == [("t.ttl", 1)]
