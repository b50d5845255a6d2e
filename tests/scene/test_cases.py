"""Every file of `cases` has exactly the problems written on its lines as `#! name "words"`."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from skillc.services.library import libraries
from skillc_dsl.diagnostics import Diagnostic
from skillc_ontology import catalogue
from skillc_runtime.scene.load import read_scene

CASES = sorted((Path(__file__).parent / "cases").glob("*.ttl"))
EXPECTED = re.compile(r'#! ([a-z-]+) "((?:[^"\\]|\\.)*)"?')


def problems(path: Path) -> tuple[Diagnostic, ...]:
    return read_scene(path, libraries.load_vocabulary()).problems


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_case(path: Path) -> None:
    lines = enumerate(path.read_text("utf-8").split("\n"), 1)
    expected = [(n, name, words.replace('\\"', '"')) for n, line in lines for name, words in EXPECTED.findall(line)]
    assert expected or path.stem == "good"
    found = problems(path)
    assert sorted((p.span.line, p.name) for p in found) == sorted((n, name) for n, name, _ in expected)
    for line, name, words in expected:
        told = [f"{p.message} | {p.help}" for p in found if (p.span.line, p.name) == (line, name)]
        assert any(words in text for text in told), (line, words, told)


@pytest.mark.parametrize("name", catalogue.scene_names())
def test_shipped_scenes_have_no_problems(name: str) -> None:
    assert problems(catalogue.scene_path(name)) == ()


def test_the_other_statement_is_shown_beside_the_one_that_breaks_an_axiom() -> None:
    axioms = next(path for path in CASES if path.stem == "axioms")
    lines = axioms.read_text("utf-8").split("\n")
    notes = {p.name: {lines[n.span.line - 1] for n in p.labels if n.span.path == str(axioms)} for p in problems(axioms)}
    assert any("lab:C a" in line for line in notes["asymmetric-relation"])
    assert any("lab:Box a" in line for line in notes["functional-property"])
    assert any("lab:B a" in line for line in notes["property-domain"])
