"""Ontologies and scenes in functional syntax, Manchester syntax and OWL/XML say what their Turtle says."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc.services.library import libraries
from skillc_dsl.source import Source
from skillc_rdf.formats.read import UnreadableError, read_content
from skillc_rdf.vocabulary.load import load
from skillc_runtime.scene.load import load_scene, read_scene
from skillc_runtime.store.triples import all_triples

TURTLE = """
@prefix t: <http://example.org/tea#> . @prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> . @prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
<http://example.org/tea> a owl:Ontology .
t:Cup a owl:Class ; rdfs:label "a cup (of tea)"@en ; rdfs:subClassOf t:Thing .
t:Pot a owl:Class . t:Tray a owl:Class . t:Thing a owl:Class .
t:Cup owl:disjointWith t:Pot, t:Tray . t:Pot owl:disjointWith t:Tray .
t:stands a owl:ObjectProperty, owl:FunctionalProperty ; rdfs:domain t:Cup ; rdfs:range t:Tray .
t:volume a owl:DatatypeProperty ; rdfs:range xsd:float .
"""
FUNCTIONAL = """# "(" in a comment
Prefix(t:=<http://example.org/tea#>)
Ontology(<http://example.org/tea>
    Declaration(Class(t:Cup)) Declaration(Class(t:Pot)) Declaration(Class(t:Tray)) Declaration(Class(t:Thing))
    Declaration(ObjectProperty(t:stands)) Declaration(DataProperty(t:volume))
    AnnotationAssertion(rdfs:label t:Cup "a cup (of tea)"@en)
    SubClassOf(t:Cup t:Thing)
    DisjointClasses(t:Cup t:Pot t:Tray)
    FunctionalObjectProperty(t:stands)
    ObjectPropertyDomain(t:stands t:Cup) ObjectPropertyRange(t:stands t:Tray)
    DataPropertyRange(t:volume xsd:float)
)
"""
MANCHESTER = """Prefix: : <http://example.org/tea#>
Ontology: <http://example.org/tea>
Class: Cup
    Annotations: rdfs:label "a cup (of tea)"@en
    SubClassOf: Thing
Class: Pot
Class: Tray
Class: Thing
ObjectProperty: stands
    Characteristics: Functional
    Domain: Cup
    Range: Tray
DataProperty: volume
    Range: xsd:float
DisjointClasses: Cup, Pot, Tray
"""
OWL_XML = """<?xml version="1.0"?>
<Ontology xmlns="http://www.w3.org/2002/07/owl#" ontologyIRI="http://example.org/tea">
<Prefix name="t" IRI="http://example.org/tea#"/>
<Prefix name="xsd" IRI="http://www.w3.org/2001/XMLSchema#"/>
<Declaration><Class abbreviatedIRI="t:Cup"/></Declaration><Declaration><Class abbreviatedIRI="t:Pot"/></Declaration>
<Declaration><Class abbreviatedIRI="t:Tray"/></Declaration><Declaration><Class abbreviatedIRI="t:Thing"/></Declaration>
<Declaration><ObjectProperty abbreviatedIRI="t:stands"/></Declaration>
<Declaration><DataProperty abbreviatedIRI="t:volume"/></Declaration>
<AnnotationAssertion><AnnotationProperty IRI="http://www.w3.org/2000/01/rdf-schema#label"/>
<IRI>http://example.org/tea#Cup</IRI><Literal xml:lang="en">a cup (of tea)</Literal></AnnotationAssertion>
<SubClassOf><Class abbreviatedIRI="t:Cup"/><Class abbreviatedIRI="t:Thing"/></SubClassOf>
<DisjointClasses>
<Class abbreviatedIRI="t:Cup"/><Class abbreviatedIRI="t:Pot"/><Class abbreviatedIRI="t:Tray"/>
</DisjointClasses>
<FunctionalObjectProperty><ObjectProperty abbreviatedIRI="t:stands"/></FunctionalObjectProperty>
<ObjectPropertyDomain><ObjectProperty abbreviatedIRI="t:stands"/><Class abbreviatedIRI="t:Cup"/></ObjectPropertyDomain>
<ObjectPropertyRange><ObjectProperty abbreviatedIRI="t:stands"/><Class abbreviatedIRI="t:Tray"/></ObjectPropertyRange>
<DataPropertyRange><DataProperty abbreviatedIRI="t:volume"/><Datatype abbreviatedIRI="xsd:float"/></DataPropertyRange>
</Ontology>
"""
SYNTAXES = {"ofn": FUNCTIONAL, "omn": MANCHESTER, "owx": OWL_XML}


def symmetric(text: str) -> set[str]:
    """Return the triples of a text; which of two disjoint classes is named first does not matter."""
    triples = read_content(Source("tea", text)).triples
    return {" ".join(sorted(map(str, each))) if "disjoint" in str(each) else str(each) for each in triples}


@pytest.mark.parametrize("suffix", SYNTAXES)
def test_a_syntax_says_what_turtle_says(suffix: str) -> None:
    assert symmetric(SYNTAXES[suffix]) == symmetric(TURTLE)


@pytest.mark.parametrize("suffix", SYNTAXES)
def test_a_library_uses_an_ontology_beside_it(suffix: str, tmp_path: Path) -> None:
    (tmp_path / f"tea.{suffix}").write_text(SYNTAXES[suffix])
    prefix = "tea" if suffix == "omn" else "t"
    skill = f"use {prefix}\nskill Serve {{ in cup: Cup  in tray: Tray  pre cup.volume > 0  pre not cup stands tray }}\n"
    (tmp_path / "serve.skill").write_text(skill)
    result = CliRunner().invoke(skillc, ["check", str(tmp_path)])
    assert result.exit_code == 0, result.output
    (tmp_path / "serve.skill").write_text(skill.replace("volume", "volumme"))
    result = CliRunner().invoke(skillc, ["check", str(tmp_path)])
    assert "volumme" in result.output and "`volume`" in result.output, result.output


WRONG = {
    "functional": (FUNCTIONAL.replace("SubClassOf", "SubKlassOf"), "not OWL's functional syntax", (7, 5)),
    "undeclared": (FUNCTIONAL.replace("t:Thing))", "x:Thing))"), "undefined prefix", (4, 102)),
    "manchester": (MANCHESTER.replace("SubClassOf", "SubKlassOf"), "not Manchester syntax", (5, 5)),
    "xml": (OWL_XML.replace("</Ontology>", ""), "not OWL/XML", (20, 1)),
    "unknown element": (OWL_XML.replace("SubClassOf", "SubKlassOf"), "found SubKlassOf", None),
    "deep": (FUNCTIONAL.replace("t:Thing)\n", "ObjectComplementOf(" * 300 + "t:Thing" + ")" * 300), "too deeply", None),
    "deep without brackets": (
        MANCHESTER.replace(": Thing", ": " + "stands some " * 9000 + "Thing"),
        "too deeply",
        None,
    ),
    "a long list": (FUNCTIONAL.replace("xsd:float", "DataOneOf(" + '"1" ' * 100_000 + ")"), "list of literals", None),
}


@pytest.mark.parametrize("kind", WRONG)
def test_what_cannot_be_read_is_said_with_its_place(kind: str) -> None:
    text, sentence, place = WRONG[kind]
    with pytest.raises(UnreadableError, match=sentence) as raised:
        read_content(Source("tea", text))
    assert place in (None, (raised.value.line, raised.value.column)), (raised.value.line, raised.value.column)


def test_without_the_extra_it_is_said_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyhornedowl", None)
    (problem,) = load([], [Source("tea.ofn", FUNCTIONAL)]).diagnostics
    assert problem.name == "unreadable-vocabulary"
    assert "OWL's functional syntax, which needs pyhornedowl" in problem.message
    assert problem.help is not None and "skillc[ontologies]" in problem.help


def test_a_scene_in_functional_syntax_has_its_facts_and_problems_at_their_subjects(tmp_path: Path) -> None:
    path = tmp_path / "scene.ofn"
    scene = """Prefix(lab:=<http://example.org/lab#>)
Prefix(skiros:=<http://rvmi.aau.dk/ontologies/skiros.owl#>)
Ontology(
    ClassAssertion(skiros:Product lab:Cup-1)
    ClassAssertion(skiros:Workstation lab:Table-1)
    ObjectPropertyAssertion(skiros:contain lab:Table-1 lab:Cup-1)
)
"""
    path.write_text(scene)
    vocabulary = libraries.load_vocabulary()
    facts = [str(each) for each in all_triples(load_scene(path, vocabulary))]
    assert any("contain" in each and "Cup-1" in each for each in facts)
    path.write_text(scene.replace("skiros:Workstation", "skiros:Wokstation"))
    (problem,) = read_scene(path, vocabulary).problems
    assert "skiros:Wokstation" in problem.message
    assert problem.span.line == 5
