"""A reasoner finds what libraries compile to consistent with their scenes, and nothing in it impossible."""

from __future__ import annotations

from pathlib import Path

import pytest
from packaged import vocabulary
from rdflib import Graph
from test_reasoning import impossible, needs_java

from skillc.services.library import libraries
from skillc.services.library.files import find_library
from skillc_compiler.emit import owl

LIBRARIES = sorted(each.parent for each in (Path(__file__).parent.parent / "cases" / "libraries").glob("*/skillc.toml"))
pytestmark = pytest.mark.reasoner


@needs_java
@pytest.mark.parametrize("library", LIBRARIES, ids=lambda each: each.name)
def test_a_described_library_is_consistent_with_its_scene(library: Path, tmp_path: Path) -> None:
    compiled = libraries.compile_library(find_library(library))
    assert compiled.ok
    described = Graph().parse(data=owl.emit(compiled.value)["skills.ttl"], format="turtle")
    graph = (vocabulary() + described).parse(library / "scene.ttl")
    assert impossible(graph, tmp_path) == []


@needs_java
def test_a_scene_that_contradicts_its_library_is_found(tmp_path: Path) -> None:
    library = next(each for each in LIBRARIES if each.name == "parking")
    compiled = libraries.compile_library(find_library(library))
    described = Graph().parse(data=owl.emit(compiled.value)["skills.ttl"], format="turtle")
    wrong = (library / "scene.ttl").read_text("utf-8") + "lab:Shuttle-1 a own:Bay .\n"
    graph = (vocabulary() + described).parse(data=wrong, format="turtle")
    assert impossible(graph, tmp_path) is None
