"""A fact that was judged from a number is explained with it, beside the number that it needs: by run, plan and why."""

from __future__ import annotations

from pathlib import Path

import pytest

from why.projects import invoke, write_project

pytestmark = pytest.mark.slow

TERMS = """@prefix t: <http://example.org/screws#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
<http://example.org/screws> a owl:Ontology .
t:Screw a owl:Class ; rdfs:subClassOf skiros:Product .
t:isTight a owl:DatatypeProperty, owl:FunctionalProperty ; rdfs:domain t:Screw ; rdfs:range xsd:boolean ;
    skillc:measure t:torque ; skillc:threshold t:neededTorque .
t:torque a owl:DatatypeProperty, owl:FunctionalProperty ; rdfs:domain t:Screw ; rdfs:range xsd:double ;
    skillc:dimension "Torque" .
t:neededTorque a owl:DatatypeProperty, owl:FunctionalProperty ; rdfs:domain t:Screw ; rdfs:range xsd:double ;
    skillc:dimension "Torque" .
t:isPacked a owl:DatatypeProperty, owl:FunctionalProperty ; rdfs:domain t:Screw ; rdfs:range xsd:boolean .
"""
SKILLS = """prefix t: <http://example.org/screws#>

skill Pack {
    in   screw: t:Screw
    pre  tight: screw.t:isTight == true
    post done:  screw.t:isPacked == true
}
impl at_once of Pack { do apply done }

task pack {
    scene "scene.ttl"
    goal  t:Screw-1.t:isPacked == true
}
"""
SCENE = """@prefix t: <http://example.org/screws#> .
t:Screw-1 a t:Screw ; t:isTight false ; t:torque 1.98 ; t:neededTorque 2.0 .
"""
BESIDE = "t:Screw-1.isTight is false (torque 1.98 Nm of 2 Nm)"


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a project whose vocabulary says from which number a property is judged."""
    write_project(tmp_path / "screws", {"screws.ttl": TERMS, "screws.skill": SKILLS, "scene.ttl": SCENE})
    monkeypatch.chdir(tmp_path / "screws")
    monkeypatch.setenv("COLUMNS", "400")
    return tmp_path / "screws"


def test_what_keeps_a_call_or_a_plan_from_succeeding_is_told_with_the_numbers(project: Path) -> None:
    call = ("--call", "Pack(screw: t:Screw-1)", "--scene", "scene.ttl", "--library", ".", "--backend", "kinematic")
    assert BESIDE in invoke("run", *call, "--out", "out", "--no-film").output
    told = invoke("why", "out").output
    assert BESIDE in told and "Ask about a step" not in told
    assert BESIDE in invoke("plan", "pack").output


def test_an_inspection_that_finds_too_little_says_how_much(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "400")
    call = ("--call", "Inspect(surface: lab:Desk-1)", "--scene", "panda_desk.ttl", "--backend", "kinematic")
    told = invoke("run", *call, "--out", "out", "--no-film").output
    assert "lab:Desk-1.isClean is false (coverage 0 of 1); needed: true" in told
    facts = invoke("why", "out", "1").output.partition("facts at that moment:")[2]
    found = invoke("why", "out", "1").output.partition("found:")[2]
    assert "lab:Desk-1.dirtMap: 0.0% clean, 100.0% dirty (confidence 1), of" in found
    assert "idealised" in found.partition("\n  failed")[0]
    assert "dirty" in (tmp_path / "out" / "dirt.svg").read_text("utf-8")
    assert "lab:Desk-1.coverage == 0" in facts and "lab:Desk-1.cleanThreshold == 1" in facts


@pytest.mark.parametrize("word", ["measure", "threshold"])
def test_a_number_that_no_property_has_is_reported_where_it_is_named(project: Path, word: str) -> None:
    assert "undeclared-term" not in invoke("check", ".").output
    said = {"measure": "t:torque", "threshold": "t:neededTorque"}[word]
    (project / "screws.ttl").write_text(TERMS.replace(f"skillc:{word} {said}", f"skillc:{word} {said}s"), "utf-8")
    told = invoke("check", ".").output
    assert f"warning[undeclared-term]: the {word} of `t:isTight`, `{said}s`, is no declared property" in told
    assert "screws.ttl:10:" in told and f"did you mean `{said}`" in told
