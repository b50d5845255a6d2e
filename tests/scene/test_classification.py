"""Definitions, axioms about expressions and chains of ontologies classify and relate the individuals of scenes."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from msgspec.structs import replace

from skillc_dsl.source import Source
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene import classification
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import LoadedScene, read_documents
from vocabularies.reading import HEAD, T, beside

TERMS = """
t:A a owl:Class . t:B a owl:Class ; rdfs:subClassOf t:A . t:C a owl:Class . t:D a owl:Class . t:E a owl:Class .
t:r a owl:ObjectProperty . t:q a owl:ObjectProperty ; rdfs:subPropertyOf t:r . t:s a owl:ObjectProperty .
t:back a owl:ObjectProperty ; owl:inverseOf t:r . t:far a owl:ObjectProperty .
t:near a owl:ObjectProperty, owl:TransitiveProperty .
t:fine a owl:DatatypeProperty, owl:FunctionalProperty ; rdfs:range xsd:boolean .
"""
SOME = "[ a owl:Restriction ; owl:onProperty t:r ; owl:someValuesFrom t:A ]"
CASES: dict[str, tuple[str, str, str]] = {
    "some value": (f"t:D owl:equivalentClass {SOME} .", "t:x a t:C ; t:q t:y . t:y a t:B .", "x is D"),
    "some value of no such class": (f"t:D owl:equivalentClass {SOME} .", "t:x a t:C ; t:q t:y . t:y a t:C .", ""),
    "by an inverse": (f"t:D owl:equivalentClass {SOME} .", "t:y a t:B ; t:back t:x . t:x a t:C .", "x is D"),
    "intersection": (
        f"t:D owl:equivalentClass [ owl:intersectionOf ( t:C {SOME} ) ] .",
        "t:x a t:C ; t:r t:y . t:y a t:B ; t:r t:y .",
        "x is D",
    ),
    "union of expressions": (
        f"t:D owl:equivalentClass [ owl:unionOf ( t:C {SOME} ) ] .",
        "t:x a t:E . t:y a t:B . t:z a t:E ; t:r t:y .",
        "z is D",
    ),
    "a value": (
        "t:D owl:equivalentClass [ a owl:Restriction ; owl:onProperty t:fine ; owl:hasValue true ] .",
        "t:x a t:C ; t:fine true . t:y a t:C ; t:fine false .",
        "x is D",
    ),
    "a value that all have": (
        "t:C rdfs:subClassOf [ a owl:Restriction ; owl:onProperty t:fine ; owl:hasValue true ] .",
        "t:x a t:C .",
        "x fine true",
    ),
    "values of a class only": (
        "t:C rdfs:subClassOf [ a owl:Restriction ; owl:onProperty t:r ; owl:allValuesFrom t:D ] .",
        "t:x a t:C ; t:q t:y . t:y a t:A .",
        "y is D",
    ),
    "listed individuals": ("t:D owl:equivalentClass [ owl:oneOf ( t:x ) ] .", "t:x a t:C . t:y a t:C .", "x is D"),
    "an axiom about an expression": (
        "[ a owl:Class ; owl:intersectionOf ( t:A t:C ) ] rdfs:subClassOf t:D .",
        "t:x a t:B, t:C . t:y a t:C .",
        "x is D",
    ),
    "a chain": (
        "t:far owl:propertyChainAxiom ( t:r t:s ) .",
        "t:x a t:C ; t:q t:y . t:y a t:C ; t:s t:z . t:z a t:C .",
        "x far z",
    ),
    "a chain over a transitive relation": (
        "t:far owl:propertyChainAxiom ( t:r t:near ) .",
        "t:x a t:C ; t:r t:y . t:y a t:C ; t:near t:z . t:z a t:C ; t:near t:w . t:w a t:C .",
        "x far w, x far z, y near w",
    ),
    "one rule after another": (
        f"t:D owl:equivalentClass {SOME} . [ owl:intersectionOf ( t:D t:C ) ] rdfs:subClassOf t:E .",
        "t:x a t:C ; t:r t:y . t:y a t:A .",
        "x is D, x is E",
    ),
    "by another name": (
        f"t:Dee a owl:Class ; owl:equivalentClass t:D . t:Dee owl:equivalentClass {SOME} .",
        "t:x a t:C ; t:r t:y . t:y a t:A .",
        "x is D",
    ),
}


def read(axioms: str, facts: str, changing: Sequence[str] = ()) -> LoadedScene:
    vocabulary = beside(Source("t.ttl", f"{HEAD}{TERMS}{axioms}")).value
    assert vocabulary.rules
    vocabulary = replace(vocabulary, changing=tuple(f"{T}{each}" for each in changing))
    return read_documents([Document.of("cell.ttl", f"{HEAD}{facts}")], vocabulary)


def derived(axioms: str, facts: str) -> set[str]:
    """Return what rules add to the facts of a scene."""
    with_rules, without = said(read(axioms, facts)), said(read_plainly(axioms, facts))
    assert without <= with_rules
    return with_rules - without


def read_plainly(axioms: str, facts: str) -> LoadedScene:
    vocabulary = beside(Source("t.ttl", f"{HEAD}{TERMS}{axioms}")).value
    return read_documents([Document.of("cell.ttl", f"{HEAD}{facts}")], replace(vocabulary, rules=()))


def said(scene: LoadedScene) -> set[str]:
    assert scene.ok, scene.problems
    state, found = scene.state, set[str]()
    for one in state.individuals:
        found |= {f"{_name(one)} is {_name(cls)}" for cls in state.types(one)}
    for relation, links in state.asserted.items():
        found |= {f"{_name(one)} {_name(relation)} {_name(other)}" for one, other in links.pairs()}
    for property_, table in state.stored.items():
        found |= {f"{_name(one)} {_name(property_)} {str(value).lower()}" for one, value in table.items()}
    return found


def _name(iri: str) -> str:
    return iri.rpartition("#")[2]


@pytest.mark.parametrize(("axioms", "facts", "expected"), CASES.values(), ids=CASES)
def test_what_follows_from_rules_is_part_of_the_scene(axioms: str, facts: str, expected: str) -> None:
    assert derived(axioms, facts) == ({*expected.split(", ")} if expected else set())


def test_what_is_used_is_not_reported_and_the_rest_is() -> None:
    rest = "t:E owl:equivalentClass [ a owl:Restriction ; owl:onProperty t:r ; owl:maxCardinality 2 ] ."
    told = [each.message for each in beside(Source("t.ttl", f"{HEAD}{TERMS}{CASES['a chain'][0]}{rest}")).diagnostics]
    assert len(told) == 1 and "chain" not in told[0] and "1 owl:maxCardinality" in told[0]


def test_the_rules_of_a_vocabulary_are_the_same_each_time() -> None:
    text = f"{HEAD}{TERMS}{' '.join(axioms for axioms, _, _ in CASES.values())}"
    one, other = (beside(Source("t.ttl", text)).value.rules for _ in range(2))
    assert one == other and len(one) > 40


def test_what_follows_from_facts_that_skills_change_is_told_and_not_used() -> None:
    axioms, facts, _ = CASES["one rule after another"]
    scene = read(axioms, facts, ["r"])
    assert said(scene) == said(read_plainly(axioms, facts))
    (warning,) = (each for each in scene.problems if each.name == "passing-class")
    assert "`t:x is a t:D`, `t:x is a t:E` would follow from facts that skills change" in warning.message


def test_a_relation_that_skills_change_is_not_derived() -> None:
    axioms, facts, _ = CASES["a chain"]
    assert not any(" far " in each for each in said(read(axioms, facts, ["far"])))


def test_what_contradicts_the_ontology_once_it_is_derived_is_an_error_of_the_scene() -> None:
    axioms, facts, _ = CASES["some value"]
    problems = read(f"{axioms} t:D owl:disjointWith t:C .", facts).problems
    assert [(each.severity, each.span.path, each.span.line) for each in problems] == [("error", "cell.ttl", 1)]
    assert "t:x" in problems[0].message and "follows from the rules of ontologies" in problems[0].message


def test_too_many_facts_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(classification, "MOST_FACTS", 1)
    (warning,) = read(CASES["some value"][0], CASES["some value"][1]).problems
    assert "they concern 2 facts, and 1 at most are read" in warning.message


def test_without_the_reasoner_a_warning_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(classification, "find_spec", lambda name: None)
    axioms, facts, _ = CASES["a chain"]
    scene = read(axioms, facts)
    (warning,) = (each for each in scene.problems if each.name == "unclassified-individuals")
    assert "skillc[ontologies]" in (warning.help or "") and said(scene) == said(read_plainly(axioms, facts))


def test_shipped_vocabularies_have_no_rules() -> None:
    assert isinstance(shipped := beside().value, Vocabulary) and shipped.rules == ()
