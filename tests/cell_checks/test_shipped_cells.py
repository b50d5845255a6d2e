"""Nothing is wrong in the cells that ship, or that `skillc new` writes."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc.services.cell_checks.checks import check_cell
from skillc.services.library import compiled_libraries, libraries
from skillc.services.library.files import find_library
from skillc.services.scaffolding.new_library import create_library
from skillc_ontology import catalogue
from skillc_runtime.scene.load import load_scene


@pytest.mark.parametrize("name", catalogue.scene_names())
def test_nothing_is_wrong_in_a_shipped_scene(name: str) -> None:
    state = load_scene(catalogue.scene_path(name), libraries.load_vocabulary())
    assert state.individuals
    assert check_cell(state) == ()


def test_nothing_is_wrong_in_a_new_library(tmp_path: Path) -> None:
    create_library(tmp_path / "mine")
    (scene,) = (tmp_path / "mine").rglob("*.ttl")
    library = compiled_libraries.compile_valid(find_library(tmp_path / "mine"))
    assert check_cell(load_scene(scene, library.vocabulary)) == ()
