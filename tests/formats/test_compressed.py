"""Scenes and ontologies that gzip has compressed are read, edited and refused as others are."""

from __future__ import annotations

import gzip
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc.services.library import libraries
from skillc_dsl import encoding
from skillc_ontology import catalogue
from skillc_runtime.scene.documents import SceneError
from skillc_runtime.scene.load import load_scene
from skillc_runtime.store.triples import all_triples

SCENE = catalogue.scene_path("iiwa_table")
PACKED = gzip.compress(SCENE.read_bytes())
SKILL = "use shop\nskill Weigh {\n    in crate: Crate\n    noplan\n}\n"
SHOP = """@prefix shop: <http://example.org/shop#> . @prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
<http://example.org/shop> a owl:Ontology .
shop:Crate a owl:Class ; rdfs:subClassOf <http://rvmi.aau.dk/ontologies/skiros.owl#Product> .
"""


def run(*arguments: str | Path) -> Result:
    result = CliRunner().invoke(skillc, [str(argument) for argument in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def test_the_content_says_that_a_scene_is_compressed_whatever_its_name(tmp_path: Path) -> None:
    path = tmp_path / "cell.ttl"
    path.write_bytes(PACKED)
    vocabulary = libraries.load_vocabulary()
    facts = set(all_triples(load_scene(path, vocabulary)))
    assert len(facts) > 50 and facts == set(all_triples(load_scene(SCENE, vocabulary)))


def test_an_edit_keeps_the_compression_and_all_else(tmp_path: Path) -> None:
    path = tmp_path / "cell.ttl.gz"
    path.write_bytes(PACKED)
    assert run("scene", "edit", path, "lab:Eraser-1.Weight == 200 g").exit_code == 0
    before, after = SCENE.read_text("utf-8").splitlines(), gzip.decompress(path.read_bytes()).decode().splitlines()
    assert len(before) == len(after) and sum(one != other for one, other in zip(before, after, strict=True)) == 1


def test_an_ontology_beside_the_skills_may_be_compressed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.skill").write_text(SKILL, "utf-8")
    assert "unknown" in run("check", ".", "--no-cache").output
    Path("shop.ttl.gz").write_bytes(gzip.compress(SHOP.encode()))
    found = run("check", ".", "--no-cache")
    assert found.exit_code == 0, found.output
    Path("shop.ttl.gz").write_bytes(gzip.compress(SHOP.encode())[:-9])
    assert "shop.ttl.gz cannot be read: it is compressed by gzip, and damaged" in run("check", ".", "--no-cache").output


@pytest.mark.parametrize(
    "content",
    [PACKED[:-1], PACKED[:40], PACKED[:2], PACKED[:300] + b"\0\0" + PACKED[302:]],
    ids=["last byte", "start", "two bytes", "two in the middle"],
)
def test_a_damaged_file_is_said_to_be(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "cell.ttl.gz"
    path.write_bytes(content)
    with pytest.raises(SceneError, match="damaged: make or copy it again"):
        load_scene(path, libraries.load_vocabulary())


def test_what_would_fill_the_memory_is_not_unpacked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(encoding, "MOST_UNPACKED", 2**20)
    path = tmp_path / "cell.ttl.gz"
    path.write_bytes(gzip.compress(b" " * (2**20 + 1)))
    with pytest.raises(SceneError, match="contains more than 1 MB"):
        load_scene(path, libraries.load_vocabulary())
