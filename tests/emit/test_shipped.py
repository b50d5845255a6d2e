"""The artifacts of the libraries that skillc ships."""

from __future__ import annotations

import shutil
from functools import cache
from importlib.resources import files
from pathlib import Path

import pytest
from rdflib import Graph

from emit.tree_rules import broken_rules
from skillc_compiler.emit.artifacts import artifacts
from skillc_compiler.library.pddl.planning import planning_domain
from skillc_compiler.library.skills import SkillLibrary
from skillc_compiler.pipeline import compile
from skillc_compiler.vocabulary.load import load
from skillc_dsl.source import Source
from skillc_ontology.catalogue import vocabulary_files


@cache
def wiping() -> SkillLibrary:
    folder = Path(str(files("skillc_skills")))
    vocabulary = load([Source(path, text) for path, text in vocabulary_files()]).value
    sources = [Source(path.name, path.read_text()) for path in sorted((folder / "wiping").glob("*.skill"))]
    shelf = {path.name: Source(f"std/{path.name}", path.read_text()) for path in (folder / "std").glob("*.skill")}
    return compile(sources, vocabulary, shelf, "wiping").value


def test_every_planned_skill_can_be_planned_with() -> None:
    domain = planning_domain(wiping())
    assert domain.excluded == ()
    assert {each.skill for each in domain.actions} == {each.name for each in wiping().skills.values() if each.planned}


def test_the_trees_keep_the_rules_of_the_format() -> None:
    trees = {path: text for path, text in artifacts(wiping()).items() if path.endswith(".xml")}
    assert "trees/Wipe.xml" in trees
    assert [(path, words) for path, text in trees.items() for words in broken_rules(text)] == []


@pytest.mark.skipif(shutil.which("java") is None, reason="the reasoner runs in Java")
def test_the_ontology_is_consistent(tmp_path: Path) -> None:
    owlready2 = pytest.importorskip("owlready2")
    file = tmp_path / "skills.nt"
    Graph().parse(data=artifacts(wiping())["skills.ttl"]).serialize(file, format="nt", encoding="utf-8")
    world = owlready2.World()
    with world.get_ontology(file.as_uri()).load():
        owlready2.sync_reasoner(world, debug=0)
    assert list(world.inconsistent_classes()) == []
    assert world["https://w3id.org/skillc/library/wiping#Wipe.wipe_lanes"] is not None
