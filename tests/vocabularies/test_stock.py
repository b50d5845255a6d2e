"""Ontologies as they are in use, with the constructs and defects that they have, are read unchanged."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from skillc_dsl.diagnostics import Outcome
from skillc_dsl.encoding import decode
from skillc_dsl.position import Position
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.types import THING, NumberType, PlainType, Signature, Vocabulary
from vocabularies.reading import HEAD, STOCK, T, beside, shipped_alone

SKIROS = "http://rvmi.aau.dk/ontologies/skiros.owl#"
SUMO = "http://www.inf.ufrgs.br/phi-group/ontologies/sumo.owl#"
CORA = "http://www.inf.ufrgs.br/phi-group/ontologies/cora.owl#"
ICORA = "http://purl.org/ieee1872-owl/cora-bare#"
FILES = tuple(Source(path.name, path.read_text("utf-8")) for path in sorted(STOCK.iterdir()))


@cache
def found_beside() -> Outcome[Vocabulary]:
    """What is read of the files beside the shipped vocabularies."""
    return beside(*FILES)


def test_files_of_every_format_are_read_without_an_error() -> None:
    assert {Path(each.path).suffix for each in FILES} == {".owl", ".jsonld", ".trig", ".nt"}
    assert found_beside().ok
    added = {
        prefix: base for prefix, base in found_beside().value.prefixes.items() if prefix not in shipped_alone().prefixes
    }
    assert added == {"icora": ICORA, **{n: f"http://example.org/{n}#" for n in ("tags", "units", "zones")}}
    for iri in (
        "http://example.org/units#Unit",
        "http://example.org/zones#Zone",
        f"{ICORA}RobotGroup",
        f"{SKIROS}Conveyor",
    ):
        assert iri in found_beside().value.classes


def test_all_that_is_not_used_is_told_once() -> None:
    found = [(d.name, d.span.path, d.span.line) for d in found_beside().diagnostics]
    assert sorted(found) == [
        ("missing-import", "cora.owl", 13),
        ("missing-import", "upper.owl", 11),
        ("several-inverses", "upper.owl", 19),
        ("shipped-term", "cell.owl", 1),
        ("shipped-term", "upper.owl", 1),
        ("undeclared-term", "cell.owl", 20),
        ("undeclared-term", "cora.owl", 17),
    ]


def test_shipped_terms_stay_as_they_are_but_for_what_they_are_below() -> None:
    before, seen = shipped_alone(), 0
    changed = {iri: term for iri, term in before.classes.items() if found_beside().value.classes[iri] != term}
    assert {
        iri: set(found_beside().value.classes[iri].parents) - set(term.parents) for iri, term in changed.items()
    } == {
        f"{SKIROS}Product": {"http://example.org/tags#Tagged"},
        f"{CORA}Robot": {"http://purl.org/ieee1872-owl/sumo-cora#Device"},
    }
    for iri, relation in before.relations.items():
        assert found_beside().value.relations[iri] == relation
        seen += 1
    assert seen > 20 and all(found_beside().value.properties[iri] == term for iri, term in before.properties.items())


def test_what_cannot_be_used_as_it_is_written_is_taken_for_what_is_meant() -> None:
    assert found_beside().value.aliases[f"{ICORA}Robot"] == f"{CORA}Robot"
    assert found_beside().value.classes[f"{SKIROS}belt"].parents == (f"{SKIROS}Conveyor",)
    assert found_beside().value.properties[f"{SKIROS}BeltSpeed"].type == NumberType("Number")
    assert found_beside().value.relations[f"{SKIROS}feeds"].functional
    ends = {each.range for each in found_beside().value.relations[f"{SKIROS}feeds"].signatures}
    assert ends == {f"{SKIROS}Conveyor", f"{SKIROS}Container"}
    single = found_beside().value.classes[f"{ICORA}SingleRoboticSystem"]
    assert single.parents == (f"{ICORA}RoboticSystem",) and single.disjoint == (f"{ICORA}CollectiveRoboticSystem",)
    assert found_beside().value.relations[f"{SUMO}isMemberOf"].inverse == f"{SUMO}member"


def test_places_are_known_in_xml() -> None:
    source = found_beside().value.classes[f"{ICORA}RobotGroup"].source
    assert source == Position("cora.owl", 21, 5)
    assert found_beside().value.properties["http://example.org/tags#serial"].source == Position("tags.jsonld", 5, 1)


@pytest.mark.parametrize(
    ("text", "name", "line"),
    [
        ('<?xml version="1.0"?>\n<Ontology xmlns="http://www.w3.org/2002/07/owl#">', "unreadable-vocabulary", 2),
        ("Prefix: t: <http://t/>\nOntology: <http://t>\nKlass: t:A", "unreadable-vocabulary", 3),
        ("<html><body>404</body></html>", "unreadable-vocabulary", 1),
        (
            '<?xml version="1.0"?>\n<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">\n<a',
            "unreadable-vocabulary",
            3,
        ),
        ('{"@context": "http://example.org/far.jsonld", "@id": "http://t/"}', "unreadable-vocabulary", 1),
        ("@prefix t: <http://t/> .\nt:A a", "broken-turtle", 2),
    ],
)
def test_files_that_cannot_be_read_are_told_with_their_line(text: str, name: str, line: int) -> None:
    outcome = beside(Source("t.owl", text))
    assert [(d.severity, d.name, d.span.line) for d in outcome.diagnostics] == [("error", name, line)]
    assert outcome.value.classes == shipped_alone().classes


def test_bytes_that_are_not_utf_8_are_told_and_the_character_for_them_is_read() -> None:
    text = HEAD + 't:A a owl:Class ; rdfs:comment "\ufffd" .'
    assert [each.name for each in beside(decode("t.ttl", text.encode() + b"\xff")).diagnostics] == ["encoding"]
    outcome = beside(decode("t.ttl", text.encode()))
    assert f"{T}A" in outcome.value.classes and outcome.ok


@pytest.mark.parametrize("count", ["9" * 5000, "\u00b2", "-1"])
def test_a_cardinality_that_is_no_small_number_has_no_effect(count: str) -> None:
    restriction = f'[ a owl:Restriction ; owl:onProperty t:has ; owl:minCardinality "{count}" ]'
    text = f"{HEAD}t:has a owl:ObjectProperty . t:A a owl:Class ; rdfs:subClassOf {restriction} ."
    assert f"{T}A" in beside(Source("t.ttl", text)).value.classes


def test_class_expressions_are_used_as_far_as_they_go() -> None:
    text = """
t:A a owl:Class . t:B a owl:Class . t:C a owl:Class ; owl:disjointUnionOf ( t:A t:B ) .
t:has a owl:ObjectProperty .
t:mass a owl:DatatypeProperty ; rdfs:range [ a rdfs:Datatype ; owl:onDatatype xsd:double ] .
t:D a owl:Class ; owl:equivalentClass [ owl:intersectionOf ( t:A
    [ a owl:Restriction ; owl:onProperty t:has ; owl:someValuesFrom t:B ]
    [ a owl:Restriction ; owl:onProperty t:mass ; owl:minCardinality 1 ] ) ] .
t:E a owl:Class ; rdfs:subClassOf [ a owl:Class ; owl:complementOf t:A ] ; owl:equivalentClass t:F . t:F a owl:Class .
"""
    found = beside(Source("t.ttl", HEAD + text))
    classes = found.value.classes
    assert [d.name for d in found.diagnostics] == ["unused-axiom"] and "1 definition" in found.diagnostics[0].message
    assert classes[f"{T}A"].parents == (f"{T}C",) and found.value.disjoint(f"{T}A", f"{T}B")
    assert classes[f"{T}D"].parents == (f"{T}A",) and classes[f"{T}D"].required == (f"{T}has", f"{T}mass")
    assert found.value.disjoint(f"{T}D", f"{T}E") and found.value.aliases[f"{T}F"] == f"{T}E"


def test_the_narrowest_of_several_domains_holds() -> None:
    text = (
        "t:p a owl:DatatypeProperty ; rdfs:domain sumo:Object, skiros:Product ; rdfs:range xsd:nonNegativeInteger .\n"
    )
    text += "t:r a owl:ObjectProperty ; rdfs:domain owl:Thing ; rdfs:range skiros:Product, sumo:Object ."
    found = beside(Source("t.ttl", HEAD + text))
    assert found.diagnostics == ()
    assert found.value.properties[f"{T}p"].domains == (f"{SKIROS}Product",)
    assert found.value.properties[f"{T}p"].type == PlainType("Int")
    assert found.value.relations[f"{T}r"].signatures == (Signature(THING, f"{SKIROS}Product"),)
