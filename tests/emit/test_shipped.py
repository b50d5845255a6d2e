"""The artifacts of the libraries that skillc ships."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from pathlib import Path

from emit.reading_back import read_back_artifact
from peers.comparing import differences_of
from skillc_compiler.emit.artifacts import make_artifacts
from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source
from skillc_model.pddl.planning import make_planning_domain
from skillc_model.skills import SkillLibrary
from skillc_ontology.catalogue import vocabulary_files
from skillc_rdf.vocabulary.load import load


@cache
def wiping() -> SkillLibrary:
    folder = Path(str(files("skillc_skills")))
    vocabulary = load([Source(path, text) for path, text in vocabulary_files()]).value
    sources = [Source(path.name, path.read_text()) for path in sorted((folder / "wiping").glob("*.skill"))]
    shelf = {path.name: Source(f"std/{path.name}", path.read_text()) for path in (folder / "std").glob("*.skill")}
    return compile(sources, vocabulary, shelf, "wiping").value


def test_every_planned_skill_can_be_planned_with() -> None:
    domain = make_planning_domain(wiping())
    assert domain.excluded == ()
    assert {each.skill for each in domain.actions} == {each.name for each in wiping().skills.values() if each.planned}


def test_another_parser_reads_the_domain() -> None:
    read_back_artifact(wiping(), make_artifacts(wiping())["domain.pddl"])


def test_the_trees_keep_the_rules_of_the_format_and_run_in_the_library() -> None:
    trees = {path: text for path, text in make_artifacts(wiping()).items() if path.endswith(".xml")}
    assert "trees/Wipe.xml" in trees
    assert [words for path, text in trees.items() for words in differences_of(path, text)] == []
