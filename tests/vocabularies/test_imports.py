"""Imported ontologies are found by catalogues, by the table of a project and by their paths; never on the network."""

from __future__ import annotations

import gzip
import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc.lsp.libraries import Libraries
from skillc.services.library.ontology_catalogue import find_in_catalogue

HEAD = """@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix shop: <http://example.org/shop#> . @prefix stock: <http://example.org/stock#> .
"""
SHOP = """<http://example.org/shop> a owl:Ontology ; owl:imports <{}> .
shop:Crate a owl:Class ; rdfs:subClassOf stock:Ware .
"""
STOCK = "<http://example.org/stock> a owl:Ontology ; owl:versionIRI <http://example.org/stock/2.1/> ."
WARE = " stock:Ware a owl:Class ; rdfs:subClassOf <http://rvmi.aau.dk/ontologies/skiros.owl#Product> .\n"
SKILL = "use shop, stock\nskill Weigh {\n    in ware: Ware\n    in crate: Crate\n    noplan\n}\n"
CATALOGUE = """<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<catalog prefer="public" xmlns="urn:oasis:names:tc:entity:xmlns:xml:catalog">{}</catalog>
"""
IRI = "http://example.org/stock"


@pytest.fixture(autouse=True)
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    for folder in ("lib", "far/away"):
        Path(folder).mkdir(parents=True)
    Path("lib/a.skill").write_text(SKILL, "utf-8")
    Path("lib/shop.ttl").write_text(HEAD + SHOP.format(IRI), "utf-8")
    Path("far/away/stock.owl").write_text(HEAD + STOCK + WARE, "utf-8")
    return tmp_path / "lib"


def found(path: str = "lib") -> list[str]:
    result = CliRunner().invoke(skillc, ["check", path, "--json", "--no-cache"])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return [each["name"] for each in json.loads(result.stdout) if each["name"] != "no-implementation"]


def catalogue(entries: str, folder: str = "lib") -> None:
    Path(folder, "catalog-v001.xml").write_text(CATALOGUE.format(entries), "utf-8")


def test_without_a_file_an_import_is_missing_and_it_is_said_what_to_do() -> None:
    result = CliRunner().invoke(skillc, ["check", "lib", "--no-cache"])
    assert "<http://example.org/stock> is imported but missing" in result.output
    assert "catalog-v001.xml" in result.output and "[imports] in skillc.toml" in result.output


ENTRIES = [
    f'<uri id="User Entered Import Resolution" name="{IRI}" uri="../far/away/stock.owl"/>',
    f'<group id="Folder Repository" xml:base="../far/"><uri name="{IRI}" uri="away/stock.owl"/></group>',
    f'<system systemId="{IRI}" uri="../far/away/stock.owl"/>',
    '<rewriteURI uriStartString="http://example.org/sto" rewritePrefix="../far/away/../sto"/>',
    '<uriSuffix uriSuffix="/stock" uri="../far/away/stock.owl"/>',
    '<nextCatalog catalog="../far/catalog-v001.xml"/>',
]


@pytest.mark.parametrize("entry", ENTRIES)
def test_a_catalogue_names_the_file_of_an_import(entry: str) -> None:
    catalogue(f'<uri name="{IRI}" uri="away/stock.owl"/>', "far")
    Path("far/stock").write_text(Path("far/away/stock.owl").read_text("utf-8"), "utf-8")
    catalogue(entry)
    assert found() == []


def test_the_longest_entry_counts_and_files_on_the_network_do_not(library: Path) -> None:
    catalogue(
        f'<uri name="{IRI}/x" uri="shop.ttl"/><rewriteURI uriStartString="http://example.org/" rewritePrefix="./"/>'
        f'<rewriteURI uriStartString="{IRI}" rewritePrefix="http://example.org/other"/>'
    )
    assert find_in_catalogue(library / "catalog-v001.xml", f"{IRI}/x") == library / "shop.ttl"
    assert find_in_catalogue(library / "catalog-v001.xml", IRI) is None
    assert find_in_catalogue(library / "catalog-v001.xml", "http://example.org/a.skill") == library / "a.skill"


def test_a_damaged_catalogue_and_one_that_names_itself_end() -> None:
    catalogue('<nextCatalog catalog="catalog-v001.xml"/>')
    assert "missing-import" in found()
    Path("lib/catalog-v001.xml").write_text("<catalog", "utf-8")
    assert "missing-import" in found()


def test_the_table_of_a_project_names_the_file_of_an_import() -> None:
    Path("lib/skillc.toml").write_text(f'name = "lib"\n[imports]\n"{IRI}" = "../far/away/stock.owl"\n', "utf-8")
    assert found() == []


@pytest.mark.parametrize(
    "written", ["../far/away/stock.owl", "file:{}/far/away/stock.owl", "http://example.org/stock/2.1"]
)
def test_an_import_may_be_a_path_and_of_a_version(written: str, tmp_path: Path) -> None:
    Path("lib/shop.ttl").write_text(HEAD + SHOP.format(written.format(tmp_path)), "utf-8")
    if "2.1" in written:
        Path("lib/stock.owl").write_text(HEAD + STOCK + WARE, "utf-8")
    assert found() == []


def test_imports_of_imports_are_found_by_the_first_catalogue_each_once() -> None:
    deeper = HEAD + STOCK.replace("/stock>", "/deep>") + WARE
    Path("far/away/stock.owl").write_text(
        f"{HEAD}{STOCK} <{IRI}> owl:imports <http://example.org/deep>, <{IRI}> .", "utf-8"
    )
    Path("far/deep.ttl.gz").write_bytes(gzip.compress(deeper.encode()))
    entry = f'<uri name="{IRI}" uri="../far/away/stock.owl"/>'
    catalogue(f'{entry}<uri name="http://example.org/deep" uri="../far/deep.ttl.gz"/>')
    assert found() == []


def test_the_editor_follows_imports_too(library: Path) -> None:
    catalogue(ENTRIES[0])
    libraries = Libraries([library])
    uri = (library / "a.skill").as_uri()
    libraries.write(uri, SKILL)
    view = libraries.view(uri)
    assert "http://example.org/stock#Ware" in view.analysis.program.vocabulary.classes
    assert list(libraries.problems_around(view.root)) == []
