"""Every file of `cases/errors` yields exactly the diagnostics written on its lines as `#! name "words"`."""

import re
from collections import Counter
from pathlib import Path

import pytest
from shipped import shelf

from skillc_compiler.checks import checks
from skillc_compiler.pipeline import compile
from skillc_compiler.vocabulary.load import load
from skillc_dsl.source import Source
from skillc_ontology.catalogue import vocabulary_files

CASES = sorted((Path(__file__).parent.parent / "cases" / "errors").glob("*.skill"))
EXPECTED = re.compile(r'#! ([a-z-]+) "([^"]*)"')


def found(path: Path) -> list[tuple[int, str, str]]:
    """Compile a case; return line, name and words of each diagnostic in it."""
    shipped = [Source(name, text) for name, text in vocabulary_files()]
    own = [Source(file.name, file.read_text()) for file in sorted(path.parent.glob(f"{path.stem}*.ttl"))]
    base = load([*shipped, *own])
    outcome = compile([Source(path.name, path.read_text())], base.value, shelf(), "cases")
    mine = [d for d in outcome.diagnostics if d.span.path == path.name]
    return [(d.span.line, d.name, f"{d.message} | {d.help}") for d in mine]


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_case(path: Path) -> None:
    lines = path.read_text().split("\n")
    expected = [(n, name, words) for n, text in enumerate(lines, 1) for name, words in EXPECTED.findall(text)]
    assert expected, "a case says what it expects"
    diagnostics = found(path)
    given, wanted = Counter((n, name) for n, name, _ in diagnostics), Counter((n, name) for n, name, _ in expected)
    surplus = [told for told in diagnostics if (given - wanted)[told[:2]]]
    assert (surplus, list((wanted - given).elements())) == ([], []), "surplus and missing diagnostics"
    for line, name, words in expected:
        told = [text for n, m, text in diagnostics if (n, m) == (line, name)]
        assert any(words in text for text in told), (line, words, told)


def test_every_check_has_a_case() -> None:
    shown = {name for path in CASES for name, _ in EXPECTED.findall(path.read_text())}
    declared = {name for check in checks() for name in check.NAMES}
    assert declared
    assert declared <= shown
