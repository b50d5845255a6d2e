"""Every file of `cases/errors` yields exactly the diagnostics written on its lines as `#! name "words"`."""

import re
from collections import Counter
from functools import cache, lru_cache
from pathlib import Path

import pytest
from shipped import shelf, vocabulary

from skillc_compiler.checks import load_checks
from skillc_compiler.pipeline import analyse, compile, lower_and_report
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.edits import apply_fixes
from skillc_dsl.parsing.parser import parse
from skillc_dsl.query import Memo
from skillc_dsl.source import Source
from skillc_ontology.catalogue import vocabulary_files
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import Vocabulary

CASES = sorted((Path(__file__).parent.parent / "cases" / "errors").glob("*.skill"))
EXPECTED = re.compile(r'#! ([a-z-]+) "([^"]*)"')


@cache
def diagnostics_of(path: Path, text: str) -> list[Diagnostic]:
    """Compile a text in place of a case; return the diagnostics in it, whose fixes cure something."""
    outcome = compile([Source(path.name, text)], vocabulary_of(path), shelf(), "cases", parsed_by=parsed_once)
    return [d for d in outcome.diagnostics if d.span.path == path.name]


def diagnostics_without_fixes(path: Path, text: str, memo: Memo) -> list[Diagnostic]:
    """Return the diagnostics in a text in place of a case, whatever their fixes cure."""
    sources = [Source(path.name, text)]
    program = analyse(sources, vocabulary_of(path), shelf(), "cases", parsed_by=parsed_once, memo=memo)
    return [d for d in lower_and_report(program, sources).diagnostics if d.span.path == path.name]


parsed_once = lru_cache(maxsize=50)(parse)


@cache
def vocabulary_of(path: Path) -> Vocabulary:
    """Return what a case may speak of: the shipped terms, and those of the vocabularies beside it."""
    own = [Source(file.name, file.read_text()) for file in sorted(path.parent.glob(f"{path.stem}*.ttl"))]
    shipped = [Source(name, turtle) for name, turtle in vocabulary_files()]
    return load([*shipped, *own]).value if own else vocabulary()


def found(path: Path) -> list[tuple[int, str, str]]:
    """Return line, name and words of each diagnostic in a case."""
    return [(d.span.line, d.name, f"{d.message} | {d.help}") for d in diagnostics_of(path, path.read_text())]


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
    declared = {name for check in load_checks() for name in check.NAMES}
    assert declared
    assert declared <= shown


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_a_fix_cures_its_problem(path: Path) -> None:
    text = path.read_text()
    told, memo = diagnostics_of(path, text), Memo()
    for diagnostic in told:
        if diagnostic.fix is None:
            continue
        cured = apply_fixes(text, [diagnostic.fix])
        same = [
            d
            for d in diagnostics_without_fixes(path, cured, memo)
            if (d.name, d.span.line) == (diagnostic.name, diagnostic.span.line)
        ]
        before = [d for d in told if (d.name, d.span.line) == (diagnostic.name, diagnostic.span.line)]
        assert len(same) < len(before), diagnostic


def test_misspelt_names_have_fixes() -> None:
    case = next(path for path in CASES if path.stem == "authoring")
    fixed = {d.name for d in diagnostics_of(case, case.read_text()) if d.fix}
    assert {"unknown-relation", "unknown-property", "unknown-skill", "unknown-value"} <= fixed
