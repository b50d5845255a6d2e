"""Ontologies of the user's: folders named by option or environment, and files beside the skills."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc.lsp.diagnostics import diagnostics_by_uri
from skillc.lsp.libraries import Libraries
from skillc_ontology import catalogue
from vocabularies.reading import STOCK

SKILL = """use skiros, plant
skill Load {
    in product: Product
    in belt:    Conveyor
    pre  product.batch > 3
    post belt contain product
    noplan
}
"""
PLANT = """@prefix plant: <http://example.org/plant#> . @prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> . @prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
<http://example.org/plant> a owl:Ontology .
plant:batch a owl:DatatypeProperty, owl:FunctionalProperty ; rdfs:domain skiros:Product ; rdfs:range xsd:int .
"""
SCENE = """@prefix lab: <http://example.org/lab#> . @prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix plant: <http://example.org/plant#> .
lab:Belt-1 a skiros:Conveyor ; skiros:BeltSpeed 0.5 . lab:Can-1 a skiros:Product ; plant:batch 4 .
"""
ROBOT = """@prefix arms: <http://example.org/arms#> . @prefix skillc: <https://w3id.org/skillc/core#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
arms:Tin a owl:Class ; rdfs:subClassOf <http://rvmi.aau.dk/ontologies/skiros.owl#Product> .
arms:own-home a skillc:Posture ; skillc:postureName "home" ; skillc:jointValues "0.0" .
"""


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "lib").mkdir()
    (tmp_path / "lib" / "load.skill").write_text(SKILL, "utf-8")
    (tmp_path / "lib" / "plant.ttl").write_text(PLANT, "utf-8")
    (tmp_path / "lib" / "scene.ttl").write_text(SCENE, "utf-8")
    shutil.copytree(STOCK, tmp_path / "stock")
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv(catalogue.VARIABLE, raising=False)
    return Path("lib")


def run(*arguments: str | Path) -> Result:
    result = CliRunner().invoke(skillc, [str(argument) for argument in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def errors(result: Result) -> list[tuple[str, str, int]]:
    found = json.loads(result.stdout)
    return [(each["name"], each["path"], each["line"]) for each in found if each["severity"] == "error"]


def test_terms_of_a_named_folder_and_of_files_beside_the_skills_are_known(library: Path) -> None:
    without = run("check", library, "--json", "--no-cache")
    assert ("unknown-class", "lib/load.skill", 4) in errors(without)
    named = run("check", library, "--ontology", "stock", "--scene", "lib/scene.ttl", "--json", "--no-cache")
    assert errors(named) == [] and named.exit_code == 0
    assert {each["path"] for each in json.loads(named.stdout)} >= {"stock/cora.owl", "stock/cell.owl"}


def test_what_was_compiled_into_the_library_is_no_vocabulary_of_it(library: Path) -> None:
    assert run("compile", library, "--ontology", "stock", "-o", library / "build").exit_code == 0
    assert (library / "build" / "skills.ttl").is_file()
    again = run("check", library, "--ontology", "stock", "--json", "--no-cache")
    assert errors(again) == []
    assert not [each for each in json.loads(again.stdout) if "build" in each["path"]]


def test_the_environment_names_folders_too_and_the_option_leaves_no_trace(
    library: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert run("check", library, "--ontology", "stock").exit_code == 0
    assert run("check", library).exit_code == 1
    monkeypatch.setenv(catalogue.VARIABLE, "stock")
    assert run("check", library).exit_code == 0
    monkeypatch.setenv(catalogue.VARIABLE, "nowhere")
    result = run("check", library)
    assert result.exit_code == 2 and "SKILLC_ONTOLOGY names nowhere" in result.stderr


CART = """plant:Cart a owl:Class ; rdfs:subClassOf skiros:PlacingPose, skiros:Product .
plant:Trolley a owl:Class ; rdfs:subClassOf plant:Cart . plant:tows a owl:ObjectProperty .
plant:Towed a owl:Class ; rdfs:subClassOf
    [ a owl:Restriction ; owl:onProperty plant:tows ; owl:someValuesFrom plant:Cart ] .
"""


@pytest.mark.parametrize("used", ["Cart", "Trolley", "Towed"])
def test_a_contradiction_in_what_is_used_stops_every_command_at_its_line(library: Path, used: str) -> None:
    with (library / "plant.ttl").open("a") as file:
        file.write(CART)
    (library / "tow.skill").write_text(f"use plant\nskill Tow {{\n    in load: {used}\n    noplan\n}}\n", "utf-8")
    result = run("check", library, "--ontology", "stock", "--json")
    (conflict,) = [each for each in json.loads(result.stdout) if each["name"] == "impossible-class"]
    assert {(each["path"], each["line"]) for each in conflict["labels"]} >= {("lib/tow.skill", 3)}
    assert errors(result) == [("impossible-class", "lib/plant.ttl", 6)] and result.exit_code == 1
    assert run("compile", library, "--ontology", "stock", "-o", "out").exit_code == 1
    assert not Path("out").exists()


def test_a_contradiction_in_what_is_not_used_is_one_warning_until_it_is_used(library: Path) -> None:
    with (library / "plant.ttl").open("a") as file:
        file.write(CART + "plant:Sled a owl:Class ; rdfs:subClassOf skiros:PlacingPose, skiros:Product .\n")
    result = run("check", library, "--ontology", "stock", "--json")
    idle = [each for each in json.loads(result.stdout) if each["name"] == "unused-conflict"]
    assert [(each["path"], each["line"]) for each in idle] == [("lib/plant.ttl", 6)] and result.exit_code == 0
    assert "2 conflicts" in idle[0]["message"] and "`plant:Cart`, `plant:Sled`" in idle[0]["message"]
    assert run("compile", library, "--ontology", "stock", "-o", "out").exit_code == 0
    (library / "load.skill").write_text(SKILL.replace("belt:    Conveyor", "belt:    Cart"), "utf-8")
    assert ("impossible-class", "lib/plant.ttl", 6) in errors(run("check", library, "--ontology", "stock", "--json"))


def test_what_is_compiled_names_no_folder_of_this_machine(library: Path, tmp_path: Path) -> None:
    assert run("compile", library, "--ontology", tmp_path / "stock", "-o", "out").exit_code == 0
    text = Path("out/library.json").read_text("utf-8")
    assert '"path":"stock/cell.owl"' in text.replace(" ", "") and str(tmp_path) not in text


def test_a_change_of_an_ontology_is_seen_by_what_remembers(library: Path) -> None:
    assert run("check", library, "--ontology", "stock").exit_code == 0
    Path("stock/cell.owl").write_text("broken", "utf-8")
    result = run("check", library, "--ontology", "stock", "--json")
    assert ("broken-turtle", "stock/cell.owl", 1) in errors(result)


def test_robots_of_the_users_are_found_with_their_sheets_and_models(
    library: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    Path("stock/robots").mkdir()
    Path("stock/robots/own.ttl").write_text(ROBOT, "utf-8")
    Path("stock/robots/own.xml").write_text("<mujoco/>", "utf-8")
    Path("arms.ttl").write_text("@prefix arms: <http://example.org/arms#> . arms:Tin-1 a arms:Tin .", "utf-8")
    result = run("world", "arms.ttl", "--ontology", "stock", "--all", "--json", "--library", library)
    listed = {each["individual"] for each in json.loads(result.stdout)}
    assert {"arms:own-home", "arms:Tin-1"} <= listed
    monkeypatch.setenv(catalogue.VARIABLE, "stock")
    assert catalogue.model_path("robots/own.xml") == Path("stock/robots/own.xml")
    monkeypatch.delenv(catalogue.VARIABLE)
    without = run("world", "arms.ttl", "--json")
    assert json.loads(without.stdout) == [] and "nothing in this scene is understood" in without.stderr


def test_a_folder_that_there_is_not_is_a_wrong_command_line(library: Path) -> None:
    result = run("check", library, "--ontology", "nowhere")
    assert result.exit_code == 2 and "nowhere" in result.stderr


def test_the_editor_knows_the_vocabularies_beside_the_skills_and_tells_what_is_wrong_with_them(library: Path) -> None:
    file = (library / "load.skill").resolve()
    shutil.copy("stock/cell.owl", library / "cell.owl")
    libraries = Libraries((file.parent,))
    libraries.write(file.as_uri(), SKILL)
    view = libraries.view(file.as_uri())
    assert {d.name for d in view.analysis.problems if d.severity == "error"} == set()
    told = diagnostics_by_uri(libraries, view.root, view.analysis, libraries.problems_around(view.root), "utf-16")
    names = {problem.code for problem in told[(file.parent / "cell.owl").as_uri()]}
    assert names == {"shipped-term", "undeclared-term"}


def test_the_editor_tells_a_contradiction_as_an_error_once_it_is_used(library: Path) -> None:
    file, plant = (library / "load.skill").resolve(), (library / "plant.ttl").resolve()
    shutil.copy("stock/cell.owl", library / "cell.owl")
    plant.write_text(PLANT + CART, "utf-8")
    libraries = Libraries((file.parent,))
    for text, expected in ((SKILL, "unused-conflict"), (SKILL.replace("Conveyor", "Cart"), "impossible-class")):
        libraries.write(file.as_uri(), text)
        view = libraries.view(file.as_uri())
        told = diagnostics_by_uri(libraries, view.root, view.analysis, libraries.problems_around(view.root), "utf-16")
        assert [problem.code for problem in told[plant.as_uri()]] == [expected]
