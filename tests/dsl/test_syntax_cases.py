"""Every file of `cases/syntax` yields the diagnostics written on its lines as `#! name "words in the message"`."""

import re
from pathlib import Path

import pytest
from lark_peer import load_parser

from skillc_dsl.diagnostics import Fix
from skillc_dsl.encoding import decode
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source

CASES = sorted((Path(__file__).parent.parent / "cases" / "syntax").glob("*.skill"))
EXPECTED = re.compile(r'#! ([a-z-]+) "([^"]*)"')


def test_there_are_cases() -> None:
    assert len(CASES) >= 8


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_case(path: Path) -> None:
    source = decode(path.name, path.read_bytes())
    outcome = parse(source)
    lines = source.text.split("\n")
    expected = [(line, name, words) for line, text in enumerate(lines, 1) for name, words in EXPECTED.findall(text)]
    assert expected, "a case says what it expects"
    assert [(d.span.line, d.name) for d in outcome.diagnostics] == [(line, name) for line, name, _ in expected]
    for diagnostic, (_, _, words) in zip(outcome.diagnostics, expected, strict=True):
        assert words in diagnostic.message
    kept = re.findall(r"#= kept: (.*)", source.text)
    assert kept, "a case says which declarations survive"
    assert [declaration.name.text for declaration in outcome.value.declarations] == kept[0].split()


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_no_message_shows_the_name_of_a_terminal(path: Path) -> None:
    terminals = {terminal.name for terminal in load_parser().terminals}
    diagnostics = parse(decode(path.name, path.read_bytes())).diagnostics
    assert diagnostics
    for diagnostic in diagnostics:
        shown = re.findall(r"[A-Z_]{2,}", re.sub(r"`[^`]*`", "", f"{diagnostic.message} {diagnostic.help}"))
        assert not terminals & set(shown)


def test_a_fix_cures_its_problem() -> None:
    fixes = 0
    for path in CASES:
        source = decode(path.name, path.read_bytes())
        before = parse(source).diagnostics
        for diagnostic in before:
            if diagnostic.fix is not None:
                after = parse(edited(source, diagnostic.fix)).diagnostics
                assert diagnostic not in after
                assert len(after) <= len(before)
                fixes += 1
    assert fixes >= 20


def edited(source: Source, fix: Fix) -> Source:
    """The source after an edit."""
    starts = [0]
    for line in source.text.split("\n"):
        starts.append(starts[-1] + len(line) + 1)
    start = starts[fix.span.line - 1] + fix.span.column - 1
    end = starts[fix.span.end_line - 1] + fix.span.end_column - 1
    return Source(source.path, source.text[:start] + fix.text + source.text[end:])
