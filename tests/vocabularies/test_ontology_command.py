"""`skillc ontology` says what a file holds, what is used, ignored and missing; `--align` proposes what it could be."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc.services.library import libraries
from skillc_ontology import catalogue

HEAD = """@prefix shop: <http://example.org/shop#> . @prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> . @prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
@prefix cora: <http://www.inf.ufrgs.br/phi-group/ontologies/cora.owl#> .
@prefix swrl: <http://www.w3.org/2003/11/swrl#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> . @prefix skos: <http://www.w3.org/2004/02/skos/core#> .
"""
SHOP = """<http://example.org/shop> a owl:Ontology ; owl:versionIRI <http://example.org/shop/7> ;
    owl:imports <http://example.org/gone>, <http://rvmi.aau.dk/ontologies/skiros.owl> .
shop:Crate a owl:Class ; rdfs:subClassOf skiros:Product, [ a owl:Restriction ; owl:onProperty shop:lid ;
    owl:someValuesFrom shop:Lid ], [ a owl:Restriction ; owl:onProperty shop:lid ; owl:allValuesFrom
    [ a owl:Restriction ; owl:onProperty shop:lid ; owl:someValuesFrom shop:Lid ] ] .
shop:Lid a owl:Class ; owl:disjointWith shop:Crate . shop:Full a owl:Class ; owl:equivalentClass
    [ owl:intersectionOf
        ( shop:Crate [ a owl:Restriction ; owl:onProperty shop:lid ; owl:someValuesFrom shop:Lid ] ) ] .
shop:lid a owl:ObjectProperty, owl:FunctionalProperty ; rdfs:domain shop:Crate ; rdfs:range shop:Lid .
shop:price a owl:DatatypeProperty ; rdfs:range xsd:decimal . shop:note a owl:AnnotationProperty .
shop:euro a shop:Currency . shop:Currency a owl:Class . [] a swrl:Imp . cora:Robot rdfs:subClassOf shop:Lid .
skiros:Product rdfs:subClassOf skiros:Location .
"""
SKILL = "use shop\nskill Close {\n    in crate: Crate\n    pre crate.price > 3\n    noplan\n}\n"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("shop.ttl").write_text(HEAD + SHOP, "utf-8")
    Path("a.skill").write_text(SKILL, "utf-8")


def run(*arguments: str) -> Result:
    result = CliRunner().invoke(skillc, ["ontology", *arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def described(*arguments: str) -> dict[str, Any]:
    (found,) = json.loads(run(*arguments, "--json").stdout)
    assert isinstance(found, dict)
    return found


def test_what_a_file_holds_is_counted_by_kind() -> None:
    found = described("shop.ttl")
    assert (found["format"], found["iris"]) == ("Turtle", ["http://example.org/shop", "http://example.org/shop/7"])
    kinds = ("classes", "relations", "properties", "annotations", "individuals")
    assert [found[kind] for kind in kinds] == [4, 1, 1, 1, 1]
    axioms = {each["kind"]: (each["count"], each["is_used"]) for each in found["axioms"]}
    assert axioms["some value"] == (2, True) and axioms["some value, within an expression"] == (1, False)
    assert axioms["owl:allValuesFrom"] == (1, False) and axioms["rule (swrl:Imp)"] == (1, False)
    assert axioms["functional"] == (1, True) and axioms["disjoint classes"] == (1, True)
    assert axioms["subclass"] == (2, True) and axioms["domain"] == (1, True) and axioms["range"] == (2, True)


def test_what_is_imported_ignored_and_linked_is_said() -> None:
    found = described("shop.ttl")
    assert found["imports"] == {"http://example.org/gone": None, "http://rvmi.aau.dk/ontologies/skiros.owl": ""}
    assert any("shipped terms have no effect: `skiros:Product`" in each for each in found["remarks"])
    links = {(each["term"], each["link"], each["shipped"]) for each in found["links"]}
    assert ("shop:Crate", "below", "skiros:Product") in links and ("shop:Full", "below", "skiros:Product") in links
    assert found["unlinked"] == {
        "shop:Currency": "class",
        "shop:Lid": "class",
        "shop:lid": "relation",
        "shop:price": "property",
    }


def test_what_a_library_uses_is_named_with_its_place() -> None:
    assert described("shop.ttl")["library"] is None
    used = described("shop.ttl", "--library", "a.skill")["used"]
    assert [(each["term"], each["path"], each["line"]) for each in used] == [
        ("shop:Crate", "a.skill", 3),
        ("shop:price", "a.skill", 4),
    ]


def test_a_page_for_people_has_it_all() -> None:
    text = run("shop.ttl", "--library", "a.skill").stdout
    for said in (
        "4 classes, 1 relation, 1 property",
        "<http://example.org/gone>: missing",
        "1 rule (swrl:Imp)",
        "a.skill:3",
    ):
        assert said in text


ALIGNED = """<http://example.org/shop> a owl:Ontology . skiros:Location rdfs:subClassOf shop:Place .
shop:robot a owl:Class . shop:B_17 a owl:Class ; rdfs:label "Product"@en . shop:Box a owl:Class .
shop:Lift a owl:Class ; skos:altLabel "container" ; rdfs:subClassOf shop:robot . shop:Place a owl:Class .
shop:contain a owl:ObjectProperty . shop:Thing a owl:Class . shop:Part a owl:Class ; owl:disjointWith shop:Place ;
    rdfs:label "location" .
"""


def test_names_and_labels_are_proposed_with_their_ground_and_what_would_be_impossible_is_a_comment() -> None:
    Path("shop.ttl").write_text(HEAD + ALIGNED, "utf-8")
    lines = run("shop.ttl", "--align").stdout.splitlines()
    assert "shop:robot rdfs:subClassOf cora:Robot .  # name robot is name Robot" in lines
    assert 'shop:B_17 rdfs:subClassOf skiros:Product .  # label "Product" is name Product' in lines
    assert "shop:contain rdfs:subPropertyOf skiros:contain .  # both have the name contain" in lines
    doubtful = [line for line in lines if line.startswith("# ")]
    assert any("shop:Lift rdfs:subClassOf skiros:Container" in line and "would not hold" in line for line in doubtful)
    assert any("shop:Part" in line and "it could be several" in line for line in doubtful)
    assert not any("shop:Box" in line or "shop:Thing" in line for line in lines)


def test_proposals_saved_beside_the_file_take_effect() -> None:
    Path("shop.ttl").write_text(HEAD + ALIGNED, "utf-8")
    Path("own").mkdir()
    Path("own/align.ttl").write_text(run("shop.ttl", "--align").stdout, "utf-8")
    Path("shop.ttl").rename("own/shop.ttl")
    with catalogue.folder_scope([Path("own")]):
        vocabulary = libraries.load_vocabulary()
    assert vocabulary.is_a(
        "http://example.org/shop#robot", "http://www.inf.ufrgs.br/phi-group/ontologies/cora.owl#Robot"
    )
    assert run("own/shop.ttl", "own/align.ttl").exit_code == 0


def test_a_file_that_is_no_ontology_is_refused_with_its_line() -> None:
    Path("shop.ttl").write_text("@prefix a: <http://a> .\na:b a:c", "utf-8")
    result = run("shop.ttl")
    assert result.exit_code == 2 and "shop.ttl:2" in result.stderr
    assert run("gone.ttl").exit_code == 2
